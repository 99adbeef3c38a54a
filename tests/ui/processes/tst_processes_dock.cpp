// SPDX-License-Identifier: GPL-3.0-or-later
// The Processes panel and the transport with real processes: each is stopped, started, restarted
// and killed by the mouse, one that is stopped by a signal is shown, and who goes on while the
// match stands still is told.
#include <QContextMenuEvent>
#include <QLabel>
#include <QMenu>
#include <QProcess>
#include <QPushButton>
#include <QTableView>
#include <QTemporaryDir>
#include <QTimer>
#include <QtTest>
#include <csignal>

#include <robotlink/blackboard/system_v.h>
#include <ui/base/notice_bar.h>
#include <ui/processes/orphan_notice.h>
#include <ui/processes/processes_dock.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/shown_moment.h>

#include "../support/real_time_robot.h"
#include "../support/segment_keys.h"
#include "processes_model.h"

namespace tst_processes_dock {

using namespace pitchboard;
using namespace pitchboard::ui;
using State = link::ProcessState;

class TestProcessesDock : public QObject {
  Q_OBJECT
  const int m_base = testKeyBase();
  std::unique_ptr<MatchController> m_controller;
  std::unique_ptr<ShownMoment> m_switch;
  std::unique_ptr<QWidget> m_dock;
  QTableView* m_table = nullptr;
  QStringList m_messages;
  std::vector<link::MatchEvent> m_events;

  link::Scenario oneRobot(const QString& runtime = {}) const {
    link::Scenario scenario = link::loadScenario("one-robot").value();
    scenario.robots[0].behaviour = "striker";
    scenario.robots[0].runtime.profile = runtime.toStdString();
    return scenario;
  }

  void open(const link::Scenario& scenario) {
    link::MatchOptions options;
    options.cognition = link::Cognition::Separate;
    options.keyBase = m_base;
    options.robotProgram = PITCHBOARD_BIN "/pitchboard-robot";
    m_controller = std::make_unique<MatchController>(options);
    m_switch = std::make_unique<ShownMoment>(m_controller.get());
    m_dock.reset(makeProcessesDock(m_controller.get(), m_switch.get(), nullptr));
    m_dock->resize(1200, 400);
    m_dock->show();
    m_table = m_dock->findChild<QTableView*>(QStringLiteral("processesTable"));
    connect(m_controller.get(), &MatchController::errorOccurred, this,
            [this](const QString& sentence) { m_messages << sentence; });
    connect(m_controller.get(), &MatchController::eventsReceived, this,
            [this](const std::vector<link::MatchEvent>& events) {
              m_events.insert(m_events.end(), events.begin(), events.end());
            });
    m_controller->open(scenario);
  }

  link::ProcessStatus process(const char* name) const {
    const FramePtr frame = m_controller->frame();
    if (!frame || frame->robots.empty()) return {};
    for (const link::ProcessStatus& one : frame->robots[0].processes()) {
      if (one.name == name) return one;
    }
    return {};
  }
  bool runs(const char* name) const {
    return process(name).state == State::Running && process(name).pid > 0;
  }
  double now() const { return m_controller->frame() ? m_controller->frame()->snapshot.time : 0.0; }
  /// m between where the robot stands and where it believes to stand.
  double beliefError() const {
    const FramePtr frame = m_controller->frame();
    const link::RobotFrame& robot = frame->robots[0];
    return robot.belief ? distance(robot.belief->position, robot.pose.position) : 1e9;
  }
  int events(link::MatchEventKind kind) const {
    return static_cast<int>(
        std::count_if(m_events.begin(), m_events.end(),
                      [kind](const link::MatchEvent& event) { return event.kind == kind; }));
  }
  /// The row of a process; -1: there is none.
  int row(const char* name) const {
    const QAbstractItemModel& model = *m_table->model();
    for (int i = 0; i < model.rowCount(); ++i) {
      if (model.index(i, ProcessesModel::Process).data() == QString::fromUtf8(name)) return i;
    }
    return -1;
  }
  QString text(const char* name, int column) const {
    return m_table->model()->index(row(name), column).data().toString();
  }

  /// Clicks with the right button on a process and with the left one on this entry of the menu.
  void choose(const char* name, const QString& entry) {
    QTRY_VERIFY(row(name) >= 0);
    // An entry cannot be chosen before the panel has seen what the one before did.
    QTRY_VERIFY2_WITH_TIMEOUT(isChosen(name, entry), qPrintable(entry), 30'000);
  }
  bool isChosen(const char* name, const QString& entry) {
    bool clicked = false;
    QTimer answer;
    connect(&answer, &QTimer::timeout, this, [&] {
      auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
      if (!menu) return;
      answer.stop();
      for (QAction* action : menu->actions()) {
        if (!action->text().remove(QLatin1Char('&')).startsWith(entry) || !action->isEnabled()) {
          continue;
        }
        clicked = true;
        QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(action).center());
        return;
      }
      menu->close();
    });
    answer.start(20);
    const QModelIndex index = m_table->model()->index(row(name), ProcessesModel::Process);
    const QPoint at = m_table->visualRect(index).center();
    QContextMenuEvent event(QContextMenuEvent::Mouse, at, m_table->viewport()->mapToGlobal(at));
    QApplication::sendEvent(m_table->viewport(), &event);
    return clicked;
  }

 private slots:
  void cleanup() {
    m_dock.reset();
    m_switch.reset();
    m_controller.reset();
    m_messages.clear();
    m_events.clear();
    removeSegment(m_base + 100);
    removeSegment(m_base + 300);
  }

  void eachByTheMouse() {
    open(oneRobot());
    QTRY_VERIFY_WITH_TIMEOUT(runs("decision") && runs("localization"), 30'000);
    const pid_t localization = process("localization").pid;
    const pid_t first = process("decision").pid;

    choose("decision", QStringLiteral("Stop decision of B1"));
    QTRY_COMPARE_WITH_TIMEOUT(process("decision").state, State::Stopped, 30'000);
    QTRY_COMPARE(text("decision", ProcessesModel::State), QStringLiteral("stopped"));
    QCOMPARE(text("decision", ProcessesModel::Pid), QString());

    choose("decision", QStringLiteral("Start decision of B1"));
    QTRY_VERIFY_WITH_TIMEOUT(runs("decision"), 30'000);
    const pid_t second = process("decision").pid;
    QVERIFY(second != first);
    QCOMPARE(process("decision").restarts, 0);

    choose("decision", QStringLiteral("Restart decision of B1"));
    QTRY_VERIFY_WITH_TIMEOUT(runs("decision") && process("decision").pid != second, 30'000);
    const pid_t third = process("decision").pid;
    QCOMPARE(events(link::MatchEventKind::ProcessDied), 0);

    // What is killed died, and is there again after the first wait.
    choose("decision", QStringLiteral("Kill decision of B1"));
    QTRY_VERIFY_WITH_TIMEOUT(runs("decision") && process("decision").pid != third, 30'000);
    QTRY_COMPARE(events(link::MatchEventKind::ProcessDied), 1);
    const auto died =
        std::find_if(m_events.begin(), m_events.end(), [](const link::MatchEvent& event) {
          return event.kind == link::MatchEventKind::ProcessDied;
        });
    const QString words = QString::fromStdString(sentenceOf(*died));
    QVERIFY2(words.contains(QStringLiteral("decision")) && words.contains(QStringLiteral("Killed")),
             qPrintable(words));
    QTRY_VERIFY(text("decision", ProcessesModel::Restarts).toInt() >= 1);

    // Nobody else was touched, and who takes turns gives signs of life.
    QCOMPARE(process("localization").pid, localization);
    QCOMPARE(process("localization").restarts, 0);
    const auto givesSigns = [this] {
      const link::ProcessStatus now = process("localization");
      const double age =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - now.started).count();
      return age > 2.0 && now.heartbeatAge && *now.heartbeatAge < 0.5 * age;
    };
    QTRY_VERIFY_WITH_TIMEOUT(givesSigns(), 30'000);
    QVERIFY2(m_messages.isEmpty(), qPrintable(m_messages.join(QLatin1Char('\n'))));

    // Nothing while the past is shown.
    auto* asNow = m_dock->findChild<QLabel*>("processesAsNow");
    QVERIFY(!asNow->isVisible());
    m_controller->edits()->setLocked(true);
    QTRY_VERIFY(asNow->isVisible());
    const pid_t last = process("decision").pid;
    const QModelIndex index = m_table->model()->index(row("decision"), ProcessesModel::Process);
    const QPoint at = m_table->visualRect(index).center();
    QTest::mouseClick(m_table->viewport(), Qt::LeftButton, {}, at);
    QVERIFY(!m_table->selectionModel()->hasSelection());
    QContextMenuEvent rightClick(QContextMenuEvent::Mouse, at,
                                 m_table->viewport()->mapToGlobal(at));
    QApplication::sendEvent(m_table->viewport(), &rightClick);
    QVERIFY(QApplication::activePopupWidget() == nullptr);
    const double then = now();
    QTRY_VERIFY(now() > then + 0.5);
    QVERIFY(runs("decision"));
    QCOMPARE(process("decision").pid, last);
  }

  void aProcessStoppedByASignalIsShownAsNotResponding() {
    QTemporaryDir folder;
    QFile profile(folder.filePath(QStringLiteral("mine.json")));
    QVERIFY(profile.open(QIODevice::WriteOnly));
    profile.write(R"({"version": 1, "name": "mine", "processes": [
      {"name": "thinks", "command": ["sleep", "600"], "response_timeout": 0.3}]})");
    profile.close();
    open(oneRobot(profile.fileName()));
    QTRY_VERIFY_WITH_TIMEOUT(runs("thinks"), 30'000);
    const pid_t pid = process("thinks").pid;
    QCOMPARE(::kill(pid, SIGSTOP), 0);
    QTRY_VERIFY_WITH_TIMEOUT(text("thinks", ProcessesModel::State).startsWith(u"not responding"),
                             30'000);
    QCOMPARE(process("thinks").pid, pid);
    QCOMPARE(::kill(pid, SIGCONT), 0);
    QTRY_COMPARE_WITH_TIMEOUT(text("thinks", ProcessesModel::State), QStringLiteral("running"),
                              30'000);
  }

  // A process that holds up lock-step is named.
  void theProcessThatDelaysLockStepIsNamed() {
    open(oneRobot());
    QTRY_VERIFY_WITH_TIMEOUT(runs("decision") && now() > 0.5, 30'000);
    m_controller->setPace(link::RobotsPace::LockStep);
    QTRY_VERIFY_WITH_TIMEOUT(m_controller->frame()->inLockStep, 30'000);
    const pid_t pid = process("decision").pid;
    QCOMPARE(::kill(pid, SIGSTOP), 0);
    const auto named = [&] {
      const link::MatchFrame& frame = *m_controller->frame();
      return frame.waitsFor == frame.robots[0].name + " decision";
    };
    QTRY_VERIFY_WITH_TIMEOUT(named(), 30'000);
    (void)::kill(pid, SIGCONT);  // unless it has been replaced
    QTRY_VERIFY_WITH_TIMEOUT(m_controller->frame()->waitsFor.empty(), 30'000);
  }

  void aChangeOfBehaviourKeepsTheOrder() {
    open(oneRobot());
    QTRY_VERIFY_WITH_TIMEOUT(runs("decision"), 30'000);
    const auto names = [this] {
      QStringList all;
      for (const link::ProcessStatus& one : m_controller->frame()->robots[0].processes()) {
        all << QString::fromStdString(one.name);
      }
      return all;
    };
    const QStringList before = names();
    QVERIFY(before.size() > 2 && before.back() != QStringLiteral("decision"));
    const pid_t pid = process("decision").pid;
    const QModelIndex chosen = m_table->model()->index(row("decision"), ProcessesModel::Process);
    QTest::mouseClick(m_table->viewport(), Qt::LeftButton, {},
                      m_table->visualRect(chosen).center());
    QVERIFY(m_table->selectionModel()->isRowSelected(row("decision")));
    m_controller->edits()->setBehaviour({RobotId{1}}, QStringLiteral("keeper"));
    QTRY_VERIFY_WITH_TIMEOUT(runs("decision") && process("decision").pid != pid, 30'000);
    QCOMPARE(names(), before);
    // What was selected is still selected.
    QCOMPARE(m_table->selectionModel()->selectedRows().size(), 1);
    QVERIFY(m_table->selectionModel()->isRowSelected(row("decision")));
  }

  // At 1x it is a choice, and the frame says which it is.
  void freelyOrInLockStep() {
    open(oneRobot());
    QTRY_VERIFY_WITH_TIMEOUT(runs("decision"), 30'000);
    QTRY_VERIFY(m_controller->frame()->inLockStep);
    m_controller->setPace(link::RobotsPace::Free);
    QTRY_VERIFY_WITH_TIMEOUT(!m_controller->frame()->inLockStep, 30'000);
    m_controller->setSpeed(2.0);
    QTRY_VERIFY_WITH_TIMEOUT(m_controller->frame()->inLockStep, 30'000);
    m_controller->setSpeed(1.0);
    QTRY_VERIFY_WITH_TIMEOUT(!m_controller->frame()->inLockStep, 30'000);
    m_controller->setPace(link::RobotsPace::LockStep);
    QTRY_VERIFY_WITH_TIMEOUT(m_controller->frame()->inLockStep, 30'000);
  }

  // Nobody is waited for where every program goes by its own clock.
  void programsThatRunFreelyAreNotInLockStep() {
    const QTemporaryDir folder;
    open(realTimeRobot(folder));
    QTRY_VERIFY_WITH_TIMEOUT(runs("decision"), 30'000);
    QCOMPARE(m_controller->pace(), link::RobotsPace::LockStep);
    QVERIFY(!m_controller->frame()->inLockStep);
    QCOMPARE(m_controller->frame()->robots[0].programs, std::vector<std::string>{"sleep"});
  }

  // The match goes on while its past is shown, and its processes with it.
  void beliefsAreAsGoodAfterLookingBack() {
    open(oneRobot());
    m_controller->setPace(link::RobotsPace::Free);
    ShownMoment& timeline = *m_switch;
    m_controller->setSpeed(10.0);
    QTRY_VERIFY_WITH_TIMEOUT(now() > 30.0, 60'000);
    m_controller->setSpeed(1.0);
    QTRY_VERIFY_WITH_TIMEOUT(!m_controller->frame()->inLockStep, 30'000);
    const double before = beliefError();
    QVERIFY2(before < 0.5, qPrintable(QString::number(before)));
    const double began = now();
    timeline.seek(10.0);
    QVERIFY(timeline.isLookingBack());
    QVERIFY(std::abs(m_switch->frame()->snapshot.time - 10.0) < 0.1);
    QTRY_VERIFY_WITH_TIMEOUT((timeline.step(-1), now() > began + 5.0), 60'000);
    QVERIFY(m_switch->frame()->snapshot.time < 10.1);
    timeline.goLive();
    QVERIFY(!timeline.isLookingBack());
    QVERIFY(m_switch->frame()->snapshot.time > began + 4.9);
    const double after = beliefError();
    qInfo("belief error %.2f m before, %.2f m after", before, after);
    QVERIFY2(after < 0.5, qPrintable(QString::number(after)));
    QVERIFY(runs("localization"));
    QCOMPARE(events(link::MatchEventKind::ProcessRestarted), 0);
    QCOMPARE(events(link::MatchEventKind::ProcessNotResponding), 0);
  }

  // A blackboard that an earlier run left: told by its key, removed when the user says so.
  void whatAnEarlierRunLeftIsOffered() {
    const int left = m_base + 300;
    QCOMPARE(QProcess::execute(QStringLiteral(SEGMENT_USER),
                               {QStringLiteral("leave"), QString::number(left)}),
             0);
    open(oneRobot());
    QTRY_VERIFY_WITH_TIMEOUT(runs("decision"), 30'000);
    const pid_t first = process("decision").pid;
    NoticeBar notices;
    showOrphanNotice(&notices, m_controller.get());
    // Nobody knows whose it was, so nobody is accused.
    QVERIFY2(notices.text().startsWith(
                 QStringLiteral("A program that has ended did not remove its blackboard (key %1)")
                     .arg(left)),
             qPrintable(notices.text()));
    QPushButton* remove = nullptr;
    for (QPushButton* button : notices.findChildren<QPushButton*>()) {
      if (button->text().remove(QLatin1Char('&')) == QStringLiteral("Remove")) remove = button;
    }
    QVERIFY(remove);
    notices.QWidget::show();
    QTest::mouseClick(remove, Qt::LeftButton);
    QTRY_VERIFY_WITH_TIMEOUT(!link::SystemVSegments::info(left), 30'000);
    QTRY_VERIFY_WITH_TIMEOUT(runs("decision") && process("decision").pid != first, 30'000);
    NoticeBar again;
    showOrphanNotice(&again, m_controller.get());
    QVERIFY(again.text().isEmpty());
  }

  // Once, where the user looks: at the first pause or other speed.
  void whoGoesOnWhileTheMatchStandsIsReportedOnce() {
    open(oneRobot(QStringLiteral("own")));
    QTRY_VERIFY_WITH_TIMEOUT(m_controller->frame() && m_controller->frame()->robots.size() == 1,
                             30'000);
    m_controller->setPaused(true);
    QVERIFY(m_messages.isEmpty());  // nobody plays it
    m_controller->setPaused(false);
    const auto mine = link::SystemVSegments::open(m_base + 100, link::AttachMode::AttachOnly);
    QVERIFY(mine);
    QTRY_VERIFY_WITH_TIMEOUT(m_controller->frame()->robots[0].ofOthers, 30'000);
    m_controller->setPaused(true);
    QCOMPARE(m_messages.size(), 1);
    QVERIFY2(m_messages.front().startsWith(
                 QStringLiteral("The processes of B1 were not started by this match")),
             qPrintable(m_messages.front()));
    m_controller->setPaused(false);
    m_controller->setSpeed(5.0);
    m_controller->setPaused(true);
    QCOMPARE(m_messages.size(), 1);
  }

  // At another speed than ×1 its clock is not the match's.
  void whoKeepsRealTimeIsReportedWhenTheSpeedChanges() {
    const QTemporaryDir folder;
    open(oneRobot(realTimeProfile(folder)));
    QTRY_VERIFY_WITH_TIMEOUT(runs("decision"), 30'000);
    QVERIFY(m_messages.isEmpty());
    m_controller->answerSpeed(8.0, MatchController::RealTimePrograms::LeaveBehind);
    QTRY_COMPARE_WITH_TIMEOUT(m_messages.size(), 1, 30'000);
    QCOMPARE(m_messages.front(),
             QStringLiteral(
                 "Real time only: B1 decision. Its runtime profile says \"clock\": \"real\"."));
  }
};

PITCHBOARD_GUI_TEST(TestProcessesDock)

}  // namespace tst_processes_dock

#include "tst_processes_dock.moc"
