// SPDX-License-Identifier: GPL-3.0-or-later
// What the window says above the field, and when it takes it back.
#include <ui/window/main_window.h>

#include <utility>

#include <ui/base/notice_bar.h>
#include <ui/experiments/situation_tests.h>
#include <ui/session/session_files.h>
#include <ui/sources/compared_session.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/match_memory.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/session_recording.h>
#include <ui/window/scenario_files.h>

namespace pitchboard::ui {

// Each thing that can go wrong is a topic: what is right again takes its notice away.
void MainWindow::connectNotices() {
  static const QString match = QStringLiteral("match"), scenario = QStringLiteral("scenario"),
                       live = QStringLiteral("live"), recording = QStringLiteral("recording"),
                       refused = QStringLiteral("refused"), locked = QStringLiteral("locked"),
                       finished = QStringLiteral("finished"), compared = QStringLiteral("compared"),
                       test = QStringLiteral("test");
  const auto tell = [this](const QString& topic) {
    return [this, topic](const QString& sentence) { m_notices->show({topic}, sentence); };
  };
  for (const auto said : {&SessionRecording::failed, &SessionRecording::noted}) {
    connect(m_recording, said, m_notices, tell(recording));
  }
  connect(m_recording, &SessionRecording::failed, this, &MainWindow::recordingFailed);
  connect(m_recording, &SessionRecording::saved, this, [this](const QString& path) {
    m_notices->show({recording, NoticeTone::Success}, QStringLiteral("Saved: %1").arg(path),
                    {{QStringLiteral("Open in Replay"), [this, path] { m_sessions->open(path); }},
                     {QStringLiteral("Close"), {}}});
  });
  connect(m_controller, &MatchController::errorOccurred, m_notices,
          [this](const QString& sentence, Trouble trouble) {
            m_notices->show({m_controller->edits()->isLocked() ? locked
                             : trouble == Trouble::Refused     ? refused
                                                               : match},
                            sentence);
          });
  connect(m_controller, &MatchController::obeyed, m_notices,
          [this] { m_notices->settle(refused); });
  connect(m_controller, &MatchController::rewound, m_notices,
          [this] { m_notices->settle(refused); });
  connect(m_controller, &MatchController::opened, m_notices, [this] {
    if (m_controller->isOpen()) m_notices->settle(scenario);
  });
  connect(m_controller, &MatchController::scenarioChanged, m_notices, [this] {
    for (const QString& topic : {match, refused, finished}) m_notices->settle(topic);
    m_toldFinished = false;
  });
  connect(m_controller->edits(), &MatchEdits::lockedChanged, m_notices,
          [this] { m_notices->settle(locked); });
  connect(m_controller->memory(), &MatchMemory::continuedWithout, m_notices, tell(match));
  connect(m_live, &LiveController::errorOccurred, m_notices, tell(live));
  connect(m_live, &LiveController::optionsChanged, m_notices, [this] { m_notices->settle(live); });
  connect(m_compared, &ComparedSession::failed, m_notices, tell(compared));
  connect(m_compared, &ComparedSession::changed, m_notices,
          [this] { m_notices->settle(compared); });
  connect(m_tests, &SituationTests::failed, m_notices, tell(test));
  connect(m_tests, &SituationTests::saved, m_notices, [this] { m_notices->settle(test); });
  connect(m_files, &ScenarioFiles::failed, m_notices, tell(scenario));
  connect(m_controller, &MatchController::frameReceived, this,
          [this](const FramePtr& frame) { tellFinished(*frame); });
}

// A match that stands still should not look as if it hung.
void MainWindow::tellFinished(const link::MatchFrame& frame) {
  if (!frame.finished) {
    if (std::exchange(m_toldFinished, false)) m_notices->settle(QStringLiteral("finished"));
    return;
  }
  if (std::exchange(m_toldFinished, true)) return;
  m_notices->show(
      {QStringLiteral("finished"), NoticeTone::Success},
      QStringLiteral("The match is over, %1 : %2. Look back on the timeline, export it, or play it "
                     "again.")
          .arg(frame.snapshot.score.left)
          .arg(frame.snapshot.score.right),
      {{QStringLiteral("Play again"),
        [this] {
          m_controller->restart();
          m_controller->setPaused(false);
        }},
       {QStringLiteral("Export…"), [this] { showExport(); }},
       {QStringLiteral("Close"), {}}});
}

}  // namespace pitchboard::ui
