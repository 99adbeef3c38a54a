// SPDX-License-Identifier: GPL-3.0-or-later
// A simulated match and a live stream in the window: what the source says, the timeline, the log,
// the recorded file and its replay have one list of events.
#include <QAbstractItemModel>

#include <robotlink/frame/match_frame.h>
#include <robotlink/session/session_events.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/replay_controller.h>

#include "../support/event_lists.h"
#include "live_rig.h"
#include "log_model.h"
#include "session_rig.h"

namespace tst_same_events_shown {

using namespace pitchboard;
using namespace pitchboard::ui;
using link::MatchEvent;
using session_rig::Studio;
using Kind = link::MatchEventKind;

namespace {

std::vector<MatchEvent> onTheTimeline(const Studio& s) {
  const auto& events = s.window.shown()->events()->events();
  return {events.begin(), events.end()};
}

QStringList inTheLog(const Studio& s) {
  const auto* log = s.window.findChild<LogModel*>(QStringLiteral("logModel"));
  QStringList lines;
  for (int row = 0; log && row < log->rowCount(); ++row) {
    lines << log->index(row, LogModel::Origin).data().toString() + QStringLiteral(": ") +
                 log->index(row, LogModel::Text).data().toString();
  }
  return lines;
}

QStringList logLinesOf(const std::vector<MatchEvent>& events) {
  QStringList lines;
  for (const MatchEvent& event : events) {
    const LogLine line = logLineOf(event);
    lines << QString::fromStdString(line.origin + ": " + line.text);
  }
  return lines;
}

/// All that a source says from now on.
std::shared_ptr<std::vector<MatchEvent>> listenTo(FrameSource* source) {
  auto received = std::make_shared<std::vector<MatchEvent>>();
  QObject::connect(source, &FrameSource::eventsReceived, source,
                   [received](const std::vector<MatchEvent>& events) {
                     received->insert(received->end(), events.begin(), events.end());
                   });
  return received;
}

bool has(const std::vector<MatchEvent>& events, Kind kind) {
  return std::any_of(events.begin(), events.end(),
                     [kind](const auto& event) { return event.kind == kind; });
}

}  // namespace

class TestSameEventsShown : public QObject {
  Q_OBJECT

  static QString stopRecording(Studio& s) {
    QSignalSpy saved(s.window.recording(), &SessionRecording::saved);
    QTest::mouseClick(s.record(), Qt::LeftButton, {}, {8, 8});
    if (!QTest::qWaitFor([&saved] { return saved.size() == 1; }, 20'000)) return {};
    return saved.at(0).at(0).toString();
  }
  /// The file has these events, and Replay shows what the file has.
  static void compareFile(Studio& s, const QString& path, const std::vector<MatchEvent>& events) {
    const auto session = telemetry::SessionReader::open(path.toStdString());
    QVERIFY2(session, qPrintable(path));
    const auto recorded = event_lists::linesOf(link::eventsOf(*session));
    QVERIFY(!recorded.isEmpty());
    QCOMPARE(recorded, event_lists::linesOf(events));
    s.window.openSession(path);
    QTRY_VERIFY(!s.window.shown()->kind().hasPresent);
    QTRY_COMPARE(event_lists::linesOf(onTheTimeline(s)), recorded);
  }

 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void ofASimulatedMatch() {
    Studio s(0);
    const auto received = listenTo(&s.controller);
    link::Scenario scenario = link::loadScenario("match-3v3").value();
    scenario.stop.duration = 10.0;
    scenario.ball = {scenario.settings.field.halfLength() - 0.3, 0.0};
    scenario.ballVelocity = {2.0, 0.0};
    s.controller.open(scenario, true);
    QTRY_VERIFY_WITH_TIMEOUT(has(*received, Kind::GameState), 20'000);
    QTest::mouseClick(s.record(), Qt::LeftButton, {}, {8, 8});
    QVERIFY2(s.window.recording()->isRecording(), qPrintable(s.notice()));
    const std::size_t before = received->size();
    s.controller.runTo(600);
    QTRY_VERIFY_WITH_TIMEOUT(has(*received, Kind::MatchOver), 60'000);
    QVERIFY(has(*received, Kind::Goal));
    QCOMPARE(event_lists::linesOf(onTheTimeline(s)), event_lists::linesOf(*received));
    QCOMPARE(inTheLog(s), logLinesOf(*received));
    const QString path = stopRecording(s);
    compareFile(s, path,
                {received->begin() + static_cast<std::ptrdiff_t>(before), received->end()});
  }

  void ofALiveStream() {
    Studio s(0);
    const link::LiveOptions options = live_rig::options();
    s.window.live()->setOptions(options);
    const auto received = listenTo(s.window.live());
    s.window.showSource(SourceKind::Live);
    QTRY_VERIFY(!s.window.live()->details().network.ports.empty());
    QTest::mouseClick(s.record(), Qt::LeftButton, {}, {8, 8});
    QVERIFY2(s.window.recording()->isRecording(), qPrintable(s.notice()));
    const live_rig::Robot robot(options, 3);
    const TestSocket referee;
    const auto send = [&](const char* file) {
      return referee.send(static_cast<std::uint16_t>(options.refereePort),
                          live_rig::packet(QLatin1String(file)));
    };
    QVERIFY(robot.sendMessage());
    QTRY_VERIFY(has(*received, Kind::RobotReceived));
    QVERIFY(send("v12hl688_INITIAL.bin"));
    QTRY_VERIFY(has(*received, Kind::RefereeReceived));
    QVERIFY(send("v12hl688_PLAYING_1-0.bin"));
    QTRY_VERIFY(has(*received, Kind::Goal));
    QCOMPARE(event_lists::linesOf(onTheTimeline(s)), event_lists::linesOf(*received));
    QCOMPARE(inTheLog(s), logLinesOf(*received));
    const QString path = stopRecording(s);
    // On a slow machine somebody falls silent behind the end of the recording.
    const auto session = telemetry::SessionReader::open(path.toStdString());
    QVERIFY(session);
    const auto count = static_cast<std::ptrdiff_t>(session->events().size());
    QTRY_VERIFY(static_cast<std::ptrdiff_t>(received->size()) >= count);
    compareFile(s, path, {received->begin(), received->begin() + count});
  }
};

PITCHBOARD_GUI_TEST(TestSameEventsShown)

}  // namespace tst_same_events_shown

#include "tst_same_events_shown.moc"
