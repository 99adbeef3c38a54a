// SPDX-License-Identifier: GPL-3.0-or-later
// A person referees a simulated match: buttons, keys, undo, the scoreboard, formations.
#include <QComboBox>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTableWidget>
#include <QUndoStack>
#include <QtTest>

#include <robotlink/scenario/scenario.h>
#include <ui/base/scoreboard_state.h>
#include <ui/referee/refereeing_dock.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>

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
    dock.reset(makeRefereeingDock(&controller, nullptr));
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
    QTRY_COMPARE(robots->rowCount(), 6);
    robots->selectRow(1);
    desk.press("Penalise");
    QTRY_COMPARE(robots->item(1, 1)->text(), QString("pickup or incapable"));
    QTRY_COMPARE(robots->item(1, 2)->text(), QString("30"));
    QCOMPARE(scoreboardOf(desk.frame()).penalties, QString("B2 30"));
    desk.controller.edits()->undoStack()->undo();
    QTRY_COMPARE(robots->item(1, 1)->text(), QString());
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
          if (a.id() == b.id()) continue;
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
};

QTEST_MAIN(TestRefereeingDock)
#include "tst_refereeing_dock.moc"
