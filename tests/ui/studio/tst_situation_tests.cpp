// SPDX-License-Identifier: GPL-3.0-or-later

// A moment becomes a test: from the menu, in Simulate, while looking back, in Live and in Replay,
// through the dialog to files that the command line plays, and at once in the dock.

#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPlainTextEdit>
#include <QProcess>
#include <QPushButton>
#include <QSpinBox>
#include <QTableView>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include <robotlink/experiment/experiment.h>
#include <ui/base/number_box.h>
#include <ui/sources/compared_session.h>
#include <ui/sources/compared_sessions.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/shown_moment.h>

#include "../support/menu_entry.h"
#include "live_rig.h"
#include "session_rig.h"

namespace tst_situation_tests {

using namespace pitchboard;
using namespace pitchboard::ui;
using session_rig::Studio;

namespace {

template <class T>
T* in(QObject* parent, const char* name) {
  T* found = parent->findChild<T*>(QLatin1String(name));
  if (found == nullptr) qFatal("there is no %s", name);
  return found;
}

/// Opens the dialog from the menu.
QDialog* dialogOf(Studio& s) {
  s.action("saveAsTest")->trigger();
  return s.window.findChild<QDialog*>(QStringLiteral("situationDialog"));
}

void fill(QDialog* dialog, const QString& folder, const char* name, const char* assertions,
          double seconds) {
  in<QLineEdit>(dialog, "testFolder")->setText(folder);
  auto* line = in<QLineEdit>(dialog, "testName");
  line->setFocus();
  line->selectAll();
  QTest::keyClicks(line, QLatin1String(name));
  in<QPlainTextEdit>(dialog, "testAssertions")->setPlainText(QLatin1String(assertions));
  in<NumberBox>(dialog, "testSeconds")->setValue(seconds);
  in<QSpinBox>(dialog, "testRuns")->setValue(2);
}

void press(QDialog* dialog, const char* button) {
  QTest::mouseClick(in<QPushButton>(dialog, button), Qt::LeftButton);
}

/// Of the second that every test here plays.
constexpr const char* always = "time_s == 1\np95(walked_m) < 10";

link::Scenario scenarioIn(const QString& file) {
  const auto read = link::loadExperiment(file.toStdString());
  if (!read) qFatal("%s", read.error().text().c_str());
  return read->conditions.front().scenario;
}

/// Everybody stands in the file as in the frame.
bool standAlike(const link::Scenario& scenario, const link::MatchFrame& frame) {
  return scenario.robots.size() == frame.robots.size() &&
         std::all_of(scenario.robots.begin(), scenario.robots.end(),
                     [&frame](const link::ScenarioRobot& robot) {
                       const link::RobotFrame* seen = frame.robot(robot.identity.id);
                       return seen && seen->identity.team == robot.identity.team &&
                              distance(seen->pose.position, robot.pose.position) < 1e-9 &&
                              std::abs(std::remainder(seen->pose.yaw - robot.pose.yaw,
                                                      6.283185307179586)) < 1e-9;
                     });
}

/// pitchboard-cli test FOLDER.
std::pair<int, QString> played(const QString& folder) {
  QProcess cli;
  cli.setProcessChannelMode(QProcess::MergedChannels);
  cli.start(QStringLiteral(PITCHBOARD_BIN "/pitchboard-cli"), {QStringLiteral("test"), folder});
  if (!cli.waitForFinished(120'000)) return {-1, cli.errorString()};
  return {cli.exitCode(), QString::fromUtf8(cli.readAll())};
}

}  // namespace

class TestSituationTests : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() {
    QStandardPaths::setTestModeEnabled(true);
    setTheme(*qApp, ThemeChoice::Dark);
  }
  void cleanupTestCase() {
    QDir(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation)).removeRecursively();
  }
  void momentsOfAMatchAndOfARecordingArePlayed();
  void momentOfLiveRobotsIsPlayed();
  void aTestIsPlayedAtOnceAndItsRunsAreSeen();
  void theDialogExplainsWhatIsNotPossible();
};

void TestSituationTests::momentsOfAMatchAndOfARecordingArePlayed() {
  Studio s(600);
  QTRY_VERIFY(s.played(600));
  const QString folder = s.folder.filePath(QStringLiteral("tests"));
  const auto save = [&](const char* name) {
    QDialog* dialog = dialogOf(s);
    fill(dialog, folder, name, always, 1.0);
    press(dialog, "testSave");
    return scenarioIn(folder + QLatin1Char('/') + QLatin1String(name) + QStringLiteral(".json"));
  };
  const FramePtr now = s.controller.frame();
  const link::Scenario ofNow = save("now");
  QVERIFY(standAlike(ofNow, *now));
  QVERIFY(distance(ofNow.ball, now->snapshot.ball) < 1e-9);
  QVERIFY(std::hypot(ofNow.ballVelocity.x - now->snapshot.ballVelocity.x,
                     ofNow.ballVelocity.y - now->snapshot.ballVelocity.y) < 1e-9);
  QVERIFY(!ofNow.settings.referee);

  s.window.shown()->seek(4.0);
  QTRY_VERIFY(s.window.shown()->isLookingBack());
  const link::Scenario before = save("looking-back");
  QVERIFY(!standAlike(before, *now));
  QVERIFY(standAlike(before, *s.controller.frameAt(4.0)));
  s.window.shown()->goLive();

  const QString session = s.recorded(60);
  QVERIFY(!session.isEmpty());
  s.window.openSession(session);
  QTRY_VERIFY(!s.window.shown()->kind().hasPresent);
  s.window.shown()->seek(s.window.shown()->available()->end);
  QTRY_VERIFY(s.window.replay()->frame() && s.window.replay()->frame()->robots.size() == 6);
  QVERIFY(standAlike(save("replay"), *s.window.replay()->frame()));

  const auto [code, text] = played(folder);
  QVERIFY2(code == 0, qPrintable(text));
  QVERIFY2(text.contains(QStringLiteral("3 tests, 6 assertions, 0 failed")), qPrintable(text));
  for (const char* name : {"now", "looking-back", "replay"}) {
    QVERIFY2(
        text.contains(
            QStringLiteral("holds   %1, as the scenario: time_s == 1").arg(QLatin1String(name))),
        qPrintable(text));
  }
}

void TestSituationTests::momentOfLiveRobotsIsPlayed() {
  Studio s(0);
  const link::LiveOptions options = live_rig::options();
  s.window.live()->setOptions(options);
  s.window.showSource(SourceKind::Live);
  QTRY_VERIFY(!s.window.live()->details().network.ports.empty());
  for (const auto& port : s.window.live()->details().network.ports) QVERIFY(port.bound);
  const live_rig::Robot one(options, 1), two(options, 2);
  QTRY_VERIFY(one.sendMessage() && two.sendMessage() && s.window.live()->frame() &&
              s.window.live()->frame()->robots.size() == 2);
  QDialog* dialog = dialogOf(s);
  auto* behaviour = in<QComboBox>(dialog, "testBehaviour");
  QVERIFY(behaviour->isVisibleTo(dialog));
  QVERIFY(!in<QComboBox>(dialog, "testPoses")->isVisibleTo(dialog));
  behaviour->setCurrentText(QStringLiteral("naive"));
  const QString folder = s.folder.filePath(QStringLiteral("tests"));
  fill(dialog, folder, "live", always, 1.0);
  press(dialog, "testSave");
  const link::Scenario scenario = scenarioIn(folder + QStringLiteral("/live.json"));
  // What the robots have said: cm from the top left corner of the field, y down.
  QCOMPARE(scenario.robots.size(), std::size_t(2));
  QCOMPARE(scenario.robots[0].behaviour, std::string("naive"));
  QVERIFY(distance(scenario.robots[0].pose.position, {1.90 - 4.5, 3.0 - 2.30}) < 1e-6);
  QVERIFY(distance(scenario.robots[1].pose.position, {2.30 - 4.5, 3.0 - 2.60}) < 1e-6);
  const auto [code, text] = played(folder);
  QVERIFY2(code == 0, qPrintable(text));
}

void TestSituationTests::aTestIsPlayedAtOnceAndItsRunsAreSeen() {
  Studio s(60);
  QTRY_VERIFY(s.played(60));
  const QString folder = s.folder.filePath(QStringLiteral("tests"));
  QDialog* dialog = dialogOf(s);
  fill(dialog, folder, "at-once", "time_s == 1\ngoal_rate == 1", 1.0);
  press(dialog, "testPlay");
  auto* dock = in<QDockWidget>(&s.window, "experiments");
  QVERIFY(dock->isVisible());
  auto* words = in<QLabel>(dock, "experimentMessage");
  QTRY_VERIFY2_WITH_TIMEOUT(
      words->text().startsWith(QStringLiteral("2 runs; 1 of 2 assertions fail")),
      qPrintable(words->text()), 60'000);
  QVERIFY(in<QComboBox>(dock, "experimentChoice")->currentText() == QStringLiteral("at-once"));
  const auto [code, text] = played(folder);
  QCOMPARE(code, 1);
  QVERIFY2(text.contains(QStringLiteral("FAILED  at-once, as the scenario: goal_rate == 1")),
           qPrintable(text));

  // Two runs over each other.
  auto* table = in<QTableView>(dock, "experimentTable");
  in<QTabWidget>(dock, "experimentTabs")->setCurrentWidget(table);
  auto* see = in<QPushButton>(dock, "experimentSeeRuns");
  QVERIFY(see->isVisible() && !see->isEnabled());
  table->selectRow(0);
  QCOMPARE(see->text(), QStringLiteral("See in Replay"));
  QTest::mouseClick(table->viewport(), Qt::LeftButton, Qt::ControlModifier,
                    table->visualRect(table->model()->index(1, 0)).center());
  QCOMPARE(see->text(), QStringLiteral("Compare on the field"));
  QTRY_VERIFY(see->visibleRegion().contains(see->rect().center()));
  QTest::mouseClick(see, Qt::LeftButton);
  QTRY_VERIFY2_WITH_TIMEOUT(
      s.window.replay()->path().endsWith(QStringLiteral("/sessions/run-000001.mcap")),
      qPrintable(words->text() + s.window.replay()->path()), 20'000);
  QTRY_COMPARE_WITH_TIMEOUT(s.window.compared()->all().size(), 1U, 60'000);
  QVERIFY(s.window.compared()->all().front()->path().endsWith(
      QStringLiteral("/sessions/run-000002.mcap")));
}

void TestSituationTests::theDialogExplainsWhatIsNotPossible() {
  Studio s(10);
  QTRY_VERIFY(s.played(10));
  QDialog* dialog = dialogOf(s);
  auto* problem = in<QLabel>(dialog, "testProblem");
  auto* assertions = in<QPlainTextEdit>(dialog, "testAssertions");
  auto* save = in<QPushButton>(dialog, "testSave");
  QCOMPARE(assertions->toPlainText(), QStringLiteral("goal_rate >= 0.8"));
  QVERIFY(save->isEnabled());
  // A template adds its line and what has to end a run for it.
  const auto boxes = dialog->findChildren<QCheckBox*>();
  const auto found = std::ranges::find(boxes, QStringLiteral("ball out"), &QCheckBox::text);
  QVERIFY(found != boxes.end());
  auto* out = *found;
  QVERIFY(!out->isChecked());
  menu_entry::beginning(in<QToolButton>(dialog, "testTemplates")->menu()->actions(),
                        QStringLiteral("The ball stays"))
      ->trigger();
  QVERIFY(out->isChecked());
  QVERIFY(assertions->toPlainText().endsWith(QStringLiteral("\nball_out_rate <= 0.1")));
  QVERIFY(save->isEnabled());
  assertions->setPlainText(QStringLiteral("gaol_rate >= 0.8"));
  QVERIFY(!save->isEnabled());
  QVERIFY2(problem->text().contains(QStringLiteral("gaol_rate")), qPrintable(problem->text()));
  assertions->clear();
  QVERIFY(!save->isEnabled());
  assertions->setPlainText(QStringLiteral("goal_rate >= 0.8"));
  in<QLineEdit>(dialog, "testFolder")->setText(QStringLiteral("/proc/no/such/folder"));
  press(dialog, "testSave");
  QVERIFY(dialog->isVisible());
  QVERIFY2(
      problem->text().contains(QStringLiteral("The folder does not exist; choose another folder")),
      qPrintable(problem->text()));
}

PITCHBOARD_GUI_TEST(TestSituationTests)

}  // namespace tst_situation_tests

#include "tst_situation_tests.moc"
