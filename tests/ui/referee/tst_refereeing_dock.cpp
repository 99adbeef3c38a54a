// SPDX-License-Identifier: GPL-3.0-or-later
// A person referees a simulated match: buttons, keys, undo, the scoreboard, formations.
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QUndoStack>
#include <QtTest>

#include <robotlink/scenario/scenario.h>
#include <robotlink/session/match_recorder.h>
#include <ui/base/scoreboard_state.h>
#include <ui/referee/refereeing_dock.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/match_memory.h>
#include <ui/sources/replay_controller.h>

namespace tst_refereeing_dock {

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

/// A paused match whose referee is a person, and the dock.
struct Desk {
  Desk() : controller(link::MatchOptions{}) {
    QObject::connect(&controller, &MatchController::errorOccurred, &controller,
                     [this](const QString& sentence) { errors << sentence; });
    link::Scenario scenario = link::loadScenario("match").value();
    scenario.settings.referee->automatic = false;
    for (auto& robot : scenario.robots) robot.behaviour = "none";
    dock.reset(makeRefereeingDock(&controller, nullptr, nullptr));
    dock->resize(400, 900);
    dock->show();
    controller.open(scenario, true);
  }
  const link::MatchFrame& frame() const { return *controller.frame(); }
  QString state() const {
    const FramePtr frame = controller.frame();
    return frame && frame->referee ? QString::fromStdString(frame->referee->state) : QString();
  }
  void press(const char* name) {
    auto* button = dock->findChild<QPushButton*>(QString("referee ") + name);
    QVERIFY2(button, name);
    QTest::mouseClick(button, Qt::LeftButton);
  }

  MatchController controller;
  std::unique_ptr<QWidget> dock;
  QStringList errors;
};

void sameScoreboard(const link::MatchFrame& now, const link::MatchFrame& past) {
  QCOMPARE(past.origin, link::FrameOrigin::Recorded);
  QVERIFY(past.referee.has_value());
  const ScoreboardState was = scoreboardOf(now), seen = scoreboardOf(past);
  QVERIFY(!was.penalties.isEmpty());
  QCOMPARE(seen.penalties, was.penalties);
  QCOMPARE(seen.clock, was.clock);
  QCOMPARE(seen.left, 0);
  QCOMPARE(seen.right, 1);
  QCOMPARE(seen.leftName, was.leftName);
  QCOMPARE(past.referee->state, now.referee->state);
  QCOMPARE(past.referee->kickOffTeam, now.referee->kickOffTeam);
  QCOMPARE(past.referee->secondaryTime, now.referee->secondaryTime);
  QCOMPARE(past.referee->version, now.referee->version);
  for (std::size_t side = 0; side < 2; ++side) {
    QCOMPARE(past.referee->teams[side].players.size(), now.referee->teams[side].players.size());
    QCOMPARE(past.referee->teams[side].playersLeft, now.referee->teams[side].playersLeft);
  }
}

}  // namespace

class TestRefereeingDock : public QObject {
  Q_OBJECT
 private slots:
  void statesByButtonsAndUndo() {
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    desk.press("READY");
    QTRY_COMPARE(desk.state(), QString("READY"));
    desk.press("SET");
    QTRY_COMPARE(desk.state(), QString("SET"));
    desk.press("PLAYING");
    QTRY_COMPARE(desk.state(), QString("PLAYING"));
    desk.controller.edits()->undoStack()->undo();
    QTRY_COMPARE(desk.state(), QString("SET"));
    desk.controller.edits()->undoStack()->redo();
    QTRY_COMPARE(desk.state(), QString("PLAYING"));
    QVERIFY(desk.errors.isEmpty());
    desk.press("SET");
    QTRY_COMPARE(desk.errors.size(), 1);
    QVERIFY2(desk.errors[0].contains("from PLAYING to SET"), qPrintable(desk.errors[0]));
    QCOMPARE(desk.state(), QString("PLAYING"));
    auto* log = desk.dock->findChild<QPlainTextEdit*>("refereeLog");
    desk.controller.stepOnce();
    QTRY_VERIFY(log->toPlainText().contains("PLAYING"));
  }

  void aGoalAndTheScoreboard() {
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    for (const char* state : {"READY", "SET", "PLAYING"}) desk.press(state);
    QTRY_COMPARE(desk.state(), QString("PLAYING"));
    desk.controller.edits()->moveBall({}, {2.0, 1.0});
    desk.press("Goal Blue");
    QTRY_COMPARE(desk.state(), QString("READY"));
    QTRY_COMPARE(scoreboardOf(desk.frame()).left, 1);
    QCOMPARE(desk.frame().snapshot.ball, (Point{0, 0}));
    desk.controller.edits()->undoStack()->undo();
    QTRY_COMPARE(scoreboardOf(desk.frame()).left, 0);
    QTRY_COMPARE(desk.frame().snapshot.ball, (Point{2.0, 1.0}));
    QCOMPARE(desk.state(), QString("PLAYING"));
  }

  void aPenaltyOfAChosenRobot() {
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    auto* robots = desk.dock->findChild<QTableWidget*>("refereeRobots");
    QTRY_COMPARE(robots->rowCount(), 8);
    robots->selectRow(1);
    desk.press("Penalise");
    QTRY_COMPARE(robots->item(1, 1)->text(), QString("pickup or incapable"));
    QTRY_COMPARE(robots->item(1, 2)->text(), QString("30"));
    QCOMPARE(scoreboardOf(desk.frame()).penalties, QString("B2 30"));
    desk.controller.edits()->undoStack()->undo();
    QTRY_COMPARE(robots->item(1, 1)->text(), QString());
  }

  void cardsAndSubstitutes() {
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    auto* robots = desk.dock->findChild<QTableWidget*>("refereeRobots");
    QTRY_COMPARE(robots->rowCount(), 8);
    const auto cards = [robots](int row) { return robots->item(row, 3)->text(); };
    const auto penalty = [robots](int row) { return robots->item(row, 1)->text(); };
    robots->selectRow(2);
    desk.press("Warn");
    QTRY_COMPARE(cards(2), QString("warned"));
    desk.press("Yellow");
    QTRY_COMPARE(cards(2), QString("warned, yellow"));
    desk.press("Red");
    QTRY_COMPARE(cards(2), QString("warned, yellow, red"));
    QTRY_COMPARE(penalty(2), QString("sent off"));
    QUndoStack* undo = desk.controller.edits()->undoStack();
    undo->undo();
    QTRY_COMPARE(cards(2), QString("warned, yellow"));
    QTRY_COMPARE(penalty(2), QString());
    // Two at once are one step.
    const int before = undo->index();
    robots->setRangeSelected({3, 0, 4, 3}, true);
    robots->setRangeSelected({2, 0, 2, 3}, false);
    desk.press("Take off");
    QTRY_COMPARE(penalty(3), QString("substitute"));
    QTRY_COMPARE(penalty(4), QString("substitute"));
    QCOMPARE(undo->index(), before + 1);
    QCOMPARE(penalty(2), QString());
    desk.press("Pardon");
    QTRY_COMPARE(penalty(3), QString());
    QTRY_COMPARE(penalty(4), QString());
    QVERIFY(desk.errors.isEmpty());
  }

  void theBallGoesWhereTheRefereeWants() {
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    auto* x = desk.dock->findChild<QDoubleSpinBox*>("refereeBallX");
    auto* y = desk.dock->findChild<QDoubleSpinBox*>("refereeBallY");
    x->selectAll();
    QTest::keyClicks(x, "1,5");  // a comma is understood
    y->selectAll();
    QTest::keyClicks(y, "-2");
    desk.press("Place");
    QTRY_COMPARE(desk.frame().snapshot.ball, (Point{1.5, -2.0}));
    desk.press("To centre");
    QTRY_COMPARE(desk.frame().snapshot.ball, (Point{0, 0}));
    desk.controller.edits()->undoStack()->undo();
    QTRY_COMPARE(desk.frame().snapshot.ball, (Point{1.5, -2.0}));
  }

  // Every call that has a key, by its key, in the order of a match.
  void everyStateByItsKey() {
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    desk.dock->activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(desk.dock.get()));
    const auto press = [&desk](Qt::Key key) {
      QTest::keyClick(desk.dock.get(), key, Qt::ControlModifier | Qt::AltModifier);
    };
    const auto says = [&desk](const char* setPlay) {
      return desk.frame().referee->setPlay == setPlay;
    };
    press(Qt::Key_3);  // blue kicks off
    press(Qt::Key_R);
    QTRY_COMPARE(desk.state(), QString("READY"));
    press(Qt::Key_S);
    QTRY_COMPARE(desk.state(), QString("SET"));
    press(Qt::Key_P);
    QTRY_COMPARE(desk.state(), QString("PLAYING"));
    press(Qt::Key_X);
    QTRY_VERIFY(desk.frame().referee->stopped);
    press(Qt::Key_G);
    QTRY_VERIFY(!desk.frame().referee->stopped);
    press(Qt::Key_K);
    QTRY_VERIFY(says("direct free kick"));
    for (int step = 0; step < 3; ++step) press(Qt::Key_N);
    QTRY_VERIFY(says(""));
    press(Qt::Key_D);
    QTRY_COMPARE(desk.state(), QString("READY"));
    press(Qt::Key_S);
    press(Qt::Key_P);
    QTRY_COMPARE(desk.state(), QString("PLAYING"));
    press(Qt::Key_2);
    QTRY_COMPARE(desk.frame().snapshot.score.right, 1);
    press(Qt::Key_S);
    press(Qt::Key_P);
    QTRY_COMPARE(desk.state(), QString("PLAYING"));
    press(Qt::Key_F);
    QTRY_COMPARE(desk.state(), QString("FINISHED"));
    press(Qt::Key_I);
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    QVERIFY(!desk.frame().referee->firstHalf);
    QVERIFY2(desk.errors.isEmpty(), qPrintable(desk.errors.join('\n')));
  }

  void aFormationComesWithItsSetPlay() {
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    for (const char* state : {"READY", "SET", "PLAYING"}) desk.press(state);
    QTRY_COMPARE(desk.state(), QString("PLAYING"));
    auto* formation = desk.dock->findChild<QComboBox*>("refereeFormation");
    formation->setCurrentIndex(formation->findText("Corner kick"));
    auto* with = desk.dock->findChild<QCheckBox*>("refereeAsSetPlay");
    QTest::mouseClick(with, Qt::LeftButton, {}, QPoint(8, with->height() / 2));
    QVERIFY(with->isChecked());
    const int before = desk.controller.edits()->undoStack()->count();
    for (QPushButton* load : desk.dock->findChildren<QPushButton*>()) {
      if (load->text() == "Right attacks") QTest::mouseClick(load, Qt::LeftButton);
    }
    QTRY_COMPARE(desk.frame().referee->setPlay, std::string("corner kick"));
    QCOMPARE(desk.frame().referee->performingTeam, desk.frame().referee->teams[1].number);
    QCOMPARE(desk.controller.edits()->undoStack()->count(), before + 1);
    desk.controller.edits()->undoStack()->undo();
    QTRY_COMPARE(desk.frame().referee->setPlay, std::string());
    QVERIFY(desk.errors.isEmpty());
  }

  // What was shown is shown again when a person looks back, and from a recording.
  void thePastShowsTheScoreboard() {
    QTemporaryDir folder;
    const std::string path = folder.filePath("refereed.mcap").toStdString();
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    const auto recorder =
        link::MatchRecorder::create(path, desk.controller.scenario(), desk.controller.catalog(),
                                    desk.controller.memory()->sampler(), {})
            .value();
    desk.controller.observe(recorder);
    for (const char* state : {"READY", "SET", "PLAYING"}) desk.press(state);
    QTRY_COMPARE(desk.state(), QString("PLAYING"));
    auto* robots = desk.dock->findChild<QTableWidget*>("refereeRobots");
    robots->selectRow(1);
    desk.press("Penalise");
    desk.press("Goal Red");
    QTRY_COMPARE(desk.frame().snapshot.score.right, 1);
    desk.controller.stepOnce();
    QTRY_VERIFY(desk.frame().snapshot.tick > 0);
    const FramePtr now = desk.controller.frame();
    FramePtr past;
    QTRY_VERIFY((past = desk.controller.frameAt(now->snapshot.time)));
    sameScoreboard(*now, *past);
    if (QTest::currentTestFailed()) return;

    desk.controller.stopObserving(recorder);
    QVERIFY(recorder->finish());
    ReplayController replay;
    QSignalSpy opened(&replay, &ReplayController::opened);
    replay.open(QString::fromStdString(path));
    QTRY_COMPARE(opened.count(), 1);
    FramePtr replayed;
    QTRY_VERIFY((replayed = replay.frameAt(now->snapshot.time)));
    sameScoreboard(*now, *replayed);
  }

  void formationsAreOneStep() {
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    const auto before = desk.frame().robots;
    auto* formation = desk.dock->findChild<QComboBox*>("refereeFormation");
    auto loads = desk.dock->findChildren<QPushButton*>();
    for (int i = 0; i < formation->count(); ++i) {
      formation->setCurrentIndex(i);
      for (QPushButton* load : loads) {
        if (load->text() == "Left attacks") QTest::mouseClick(load, Qt::LeftButton);
      }
      QCOMPARE(desk.controller.edits()->undoStack()->count(), 1);
      QTRY_VERIFY(desk.frame().robots[1].pose != before[1].pose);
      for (const link::RobotFrame& a : desk.frame().robots) {
        for (const link::RobotFrame& b : desk.frame().robots) {
          if (a.key == b.key) continue;
          QVERIFY2(distance(a.pose.position, b.pose.position) > 0.27,
                   qPrintable(formation->currentText()));
        }
        QVERIFY(distance(a.pose.position, desk.frame().snapshot.ball) > 0.2);
      }
      desk.controller.edits()->undoStack()->undo();
      QTRY_COMPARE(desk.frame().robots[1].pose, before[1].pose);
      desk.controller.edits()->undoStack()->clear();
    }
  }

  void rulesCanBeChosen() {
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    auto* rules = desk.dock->findChild<QComboBox*>("refereeRules");
    QTRY_COMPARE(rules->currentData().toString(), QString("humanoid-2021"));
    rules->setCurrentIndex(0);
    emit rules->activated(0);
    QTRY_VERIFY(!desk.frame().referee);
    auto* ready = desk.dock->findChild<QPushButton*>("referee READY");
    QTRY_VERIFY(!ready->isEnabled());
    rules->setCurrentIndex(3);
    emit rules->activated(3);
    QTRY_VERIFY(desk.frame().referee.has_value());
    QTRY_COMPARE(desk.frame().refereeRules, std::string("humanoid-soccer-2026"));
  }

  void otherRulesAreUndone_data() {
    QTest::addColumn<int>("rules");
    QTest::newRow("no referee") << 0;
    QTest::newRow("2026") << 3;
  }
  void otherRulesAreUndone() {
    QFETCH(int, rules);
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    for (const char* state : {"READY", "SET", "PLAYING", "Goal Red"}) desk.press(state);
    for (const char* state : {"SET", "PLAYING"}) desk.press(state);
    QTRY_COMPARE(desk.state(), QString("PLAYING"));
    QTRY_COMPARE(scoreboardOf(desk.frame()).right, 1);
    auto* robots = desk.dock->findChild<QTableWidget*>("refereeRobots");
    robots->selectRow(0);
    desk.press("Penalise");
    QTRY_VERIFY(desk.frame().robots[0].penalty.has_value());
    desk.controller.runTo(90);
    QTRY_COMPARE(desk.frame().snapshot.tick, std::uint64_t(90));
    const std::uint64_t hash = desk.controller.stateHash();
    const link::MatchFrame before = desk.frame();
    QUndoStack* stack = desk.controller.edits()->undoStack();
    const int steps = stack->count();

    auto* box = desk.dock->findChild<QComboBox*>("refereeRules");
    const std::string name = box->itemData(rules).toString().toStdString();
    box->setCurrentIndex(rules);
    emit box->activated(rules);
    QTRY_COMPARE(desk.frame().refereeRules, rules == 0 ? std::string() : name);
    if (rules != 0) QCOMPARE(scoreboardOf(desk.frame()).right, 0);
    QCOMPARE(stack->count(), steps + 1);
    stack->undo();
    QTRY_COMPARE(desk.frame().refereeRules, std::string("humanoid-2021"));
    QCOMPARE(desk.controller.stateHash(), hash);
    QCOMPARE(scoreboardOf(desk.frame()).clock, scoreboardOf(before).clock);
    QCOMPARE(scoreboardOf(desk.frame()).penalties, scoreboardOf(before).penalties);
    stack->redo();
    QTRY_COMPARE(desk.frame().refereeRules, rules == 0 ? std::string() : name);
    stack->undo();
    QTRY_COMPARE(desk.controller.stateHash(), hash);
    // What was done before it can still be undone.
    stack->undo();
    QTRY_VERIFY(!desk.frame().robots[0].penalty.has_value());
    QVERIFY(desk.errors.isEmpty());
  }

  void whoCallsIsUndone() {
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    auto* automatic = desk.dock->findChild<QCheckBox*>("refereeAutomatic");
    QVERIFY(!automatic->isChecked());
    automatic->click();
    QTRY_VERIFY(desk.frame().refereeAutomatic);
    desk.controller.edits()->undoStack()->undo();
    QTRY_VERIFY(!desk.frame().refereeAutomatic);
    QTRY_VERIFY(!automatic->isChecked());
  }
};

PITCHBOARD_GUI_TEST(TestRefereeingDock)

}  // namespace tst_refereeing_dock

#include "tst_refereeing_dock.moc"
