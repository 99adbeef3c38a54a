// SPDX-License-Identifier: GPL-3.0-or-later
// What a person sets up in the Referee panel: rules, who calls, formations, the ball.
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <QUndoStack>
#include <QtTest>

#include <simcore/rules/referee.h>
#include <ui/base/scoreboard_state.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>

#include "referee_rig.h"

namespace tst_referee_rules {

using namespace pitchboard;
using namespace pitchboard::ui;
using referee_rig::RefereeRig;

namespace {

/// Empty: no referee.
std::string ruleSet(const link::MatchFrame& frame) {
  return frame.rules ? frame.rules->name : std::string();
}

}  // namespace

class TestRefereeRules : public QObject {
  Q_OBJECT
 private slots:
  void theBallIsPlacedByTheReferee() {
    RefereeRig rig;
    QTRY_COMPARE(rig.state(), QString("INITIAL"));
    rig.openFold();
    auto* x = rig.dock->findChild<QDoubleSpinBox*>("refereeBallX");
    auto* y = rig.dock->findChild<QDoubleSpinBox*>("refereeBallY");
    x->selectAll();
    QTest::keyClicks(x, "1,5");  // a comma is understood
    y->selectAll();
    QTest::keyClicks(y, "-2");
    rig.press("Place");
    QTRY_COMPARE(rig.frame().snapshot.ball, (Point{1.5, -2.0}));
    rig.press("To centre");
    QTRY_COMPARE(rig.frame().snapshot.ball, (Point{0, 0}));
    rig.controller.edits()->undoStack()->undo();
    QTRY_COMPARE(rig.frame().snapshot.ball, (Point{1.5, -2.0}));
  }

  void aFormationComesWithItsSetPlay() {
    RefereeRig rig;
    QTRY_COMPARE(rig.state(), QString("INITIAL"));
    rig.reach("PLAYING");
    rig.openFold();
    auto* formation = rig.dock->findChild<QComboBox*>("refereeFormation");
    formation->setCurrentIndex(formation->findText("Corner kick"));
    auto* with = rig.dock->findChild<QCheckBox*>("refereeAsSetPlay");
    QTest::mouseClick(with, Qt::LeftButton, {}, QPoint(8, with->height() / 2));
    QVERIFY(with->isChecked());
    QTRY_COMPARE(rig.undo()->count(), 3);
    const int before = rig.undo()->count();
    for (QPushButton* load : rig.dock->findChildren<QPushButton*>()) {
      if (load->text() == "Right attacks") QTest::mouseClick(load, Qt::LeftButton);
    }
    QTRY_COMPARE(rig.frame().game->setPlay(), SetPlay::CornerKick);
    QCOMPARE(rig.frame().game->setPlayTeam(), rig.frame().game->swapped ? 0 : 1);
    QTRY_COMPARE(rig.undo()->count(), before + 1);
    rig.undo()->undo();
    QTRY_COMPARE(rig.frame().game->setPlay(), SetPlay::None);
    QVERIFY(rig.errors.isEmpty());
  }

  void formationsAreOneStep() {
    RefereeRig rig;
    QTRY_COMPARE(rig.state(), QString("INITIAL"));
    const auto before = rig.frame().robots;
    rig.openFold();
    auto* formation = rig.dock->findChild<QComboBox*>("refereeFormation");
    auto loads = rig.dock->findChildren<QPushButton*>();
    for (int i = 0; i < formation->count(); ++i) {
      formation->setCurrentIndex(i);
      for (QPushButton* load : loads) {
        if (load->text() == "Left attacks") QTest::mouseClick(load, Qt::LeftButton);
      }
      QTRY_COMPARE(rig.undo()->count(), 1);
      QTRY_VERIFY(rig.frame().robots[1].pose != before[1].pose);
      for (const link::RobotFrame& a : rig.frame().robots) {
        for (const link::RobotFrame& b : rig.frame().robots) {
          if (a.key == b.key) continue;
          QVERIFY2(distance(a.pose.position, b.pose.position) > 0.27,
                   qPrintable(formation->currentText()));
        }
        QVERIFY(distance(a.pose.position, rig.frame().snapshot.ball) > 0.2);
      }
      rig.controller.edits()->undoStack()->undo();
      QTRY_COMPARE(rig.frame().robots[1].pose, before[1].pose);
      rig.controller.edits()->undoStack()->clear();
    }
  }

  // The rules of 2021 give a goal kick where halfway line and touch line meet.
  void aGoalKickIsWhereTheRulesPutIt() {
    RefereeRig rig;
    QTRY_COMPARE(rig.state(), QString("INITIAL"));
    rig.openFold();
    auto* formation = rig.dock->findChild<QComboBox*>("refereeFormation");
    formation->setCurrentIndex(formation->findText("Goal kick"));
    for (QPushButton* load : rig.dock->findChildren<QPushButton*>()) {
      if (load->text() == "Left attacks") QTest::mouseClick(load, Qt::LeftButton);
    }
    QTRY_COMPARE(rig.undo()->count(), 1);
    const sim::FieldSpec& field = rig.frame().settings->field;
    const Point placed =
        sim::setPlayPlace(SetPlay::GoalKick, 1.0, {field.halfLength(), field.halfWidth()},
                          rig.frame().rules->style, field);
    QTRY_COMPARE(rig.frame().snapshot.ball.x, placed.x);
    QCOMPARE(rig.frame().rules->style, sim::RefereeStyle::Humanoid2021);
    QCOMPARE(placed.x, 0.0);
  }

  void whoIsPenalisedIsLeftOutOfAFormation() {
    RefereeRig rig;
    QTRY_COMPARE(rig.state(), QString("INITIAL"));
    rig.openFold();
    rig.choose(1);
    rig.press("Penalise");
    QTRY_VERIFY(rig.frame().robots[1].penalty.has_value());
    const auto before = rig.frame().robots;
    auto* hasText = rig.dock->findChild<QLabel*>("refereeStaysOff");
    QTRY_COMPARE(hasText->text(), QString("B2 is penalised and stays off the field."));
    for (QPushButton* load : rig.dock->findChildren<QPushButton*>()) {
      if (load->text() == "Left attacks") QTest::mouseClick(load, Qt::LeftButton);
    }
    QTRY_VERIFY(rig.frame().robots[2].pose != before[2].pose);
    QCOMPARE(rig.frame().robots[1].pose, before[1].pose);
  }

  void rulesCanBeChosen() {
    RefereeRig rig;
    QTRY_COMPARE(rig.state(), QString("INITIAL"));
    auto* rules = rig.dock->findChild<QComboBox*>("refereeRules");
    QTRY_COMPARE(rules->currentData().toString(), QString("humanoid-2021"));
    rules->setCurrentIndex(0);
    emit rules->activated(0);
    QTRY_VERIFY(!rig.frame().game);
    QTRY_VERIFY(!rig.button("READY")->isVisible());
    QVERIFY(rules->isVisible());  // without a referee the fold is open
    rules->setCurrentIndex(3);
    emit rules->activated(3);
    QTRY_VERIFY(rig.frame().game.has_value());
    QTRY_COMPARE(ruleSet(rig.frame()), std::string("humanoid-soccer-2026"));
  }

  void otherRulesAreUndone_data() {
    QTest::addColumn<int>("rules");
    QTest::newRow("no referee") << 0;
    QTest::newRow("2026") << 3;
  }
  void otherRulesAreUndone() {
    QFETCH(int, rules);
    RefereeRig rig;
    QTRY_COMPARE(rig.state(), QString("INITIAL"));
    rig.reach("PLAYING");
    rig.press("Goal right");
    QTRY_COMPARE(rig.state(), QString("READY"));
    rig.press("SET");
    rig.press("PLAYING");
    QTRY_COMPARE(rig.state(), QString("PLAYING"));
    QTRY_COMPARE(scoreboardOf(rig.frame()).right, 1);
    rig.choose(0);
    rig.press("Penalise");
    QTRY_VERIFY(rig.frame().robots[0].penalty.has_value());
    rig.controller.runTo(90);
    QTRY_COMPARE(rig.frame().snapshot.tick, std::uint64_t(90));
    const std::uint64_t hash = rig.controller.stateHash();
    const link::MatchFrame before = rig.frame();
    QUndoStack* stack = rig.controller.edits()->undoStack();
    const int steps = stack->count();

    auto* box = rig.dock->findChild<QComboBox*>("refereeRules");
    const std::string name = box->itemData(rules).toString().toStdString();
    box->setCurrentIndex(rules);
    emit box->activated(rules);
    QTRY_COMPARE(ruleSet(rig.frame()), rules == 0 ? std::string() : name);
    if (rules != 0) QCOMPARE(scoreboardOf(rig.frame()).right, 0);
    QTRY_COMPARE(stack->count(), steps + 1);
    const auto reported = [&rig] {
      return std::ranges::count_if(rig.moment.events()->events(), [](const auto& event) {
        return event.kind == link::MatchEventKind::SettingChanged && event.detail == "rules";
      });
    };
    QTRY_COMPARE(reported(), 1);
    stack->undo();
    QTRY_COMPARE(reported(), 0);
    QTRY_COMPARE(ruleSet(rig.frame()), std::string("humanoid-2021"));
    QCOMPARE(rig.controller.stateHash(), hash);
    QCOMPARE(scoreboardOf(rig.frame()).clock, scoreboardOf(before).clock);
    QCOMPARE(scoreboardOf(rig.frame()).penalties, scoreboardOf(before).penalties);
    stack->redo();
    QTRY_COMPARE(ruleSet(rig.frame()), rules == 0 ? std::string() : name);
    stack->undo();
    QTRY_COMPARE(rig.controller.stateHash(), hash);
    // What was done before it can still be undone.
    stack->undo();
    QTRY_VERIFY(!rig.frame().robots[0].penalty.has_value());
    QVERIFY(rig.errors.isEmpty());
  }

  void whoCallsIsUndone() {
    RefereeRig rig;
    QTRY_COMPARE(rig.state(), QString("INITIAL"));
    auto* automatic = rig.dock->findChild<QCheckBox*>("refereeAutomatic");
    QVERIFY(!automatic->isChecked());
    QTRY_VERIFY(automatic->isEnabled());
    automatic->click();
    QTRY_VERIFY(rig.frame().rules->automatic);
    QTRY_COMPARE(rig.undo()->count(), 1);
    const auto& events = rig.moment.events()->events();
    QTRY_COMPARE(
        std::ranges::count(events, link::MatchEventKind::SettingChanged, &link::MatchEvent::kind),
        1);
    rig.undo()->undo();
    QTRY_VERIFY(!rig.frame().rules->automatic);
    QTRY_VERIFY(!automatic->isChecked());
  }
};

PITCHBOARD_GUI_TEST(TestRefereeRules)

}  // namespace tst_referee_rules

#include "tst_referee_rules.moc"
