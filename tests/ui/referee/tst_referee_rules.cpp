// SPDX-License-Identifier: GPL-3.0-or-later
// What a person sets up in the Referee panel: rules, who calls, formations, the ball.
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <QUndoStack>
#include <QtTest>

#include <ui/base/scoreboard_state.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>

#include "referee_rig.h"

namespace tst_referee_rules {

using namespace pitchboard;
using namespace pitchboard::ui;
using referee_rig::Desk;

class TestRefereeRules : public QObject {
  Q_OBJECT
 private slots:
  void theBallIsPlacedByTheReferee() {
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    desk.openFold();
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

  void aFormationComesWithItsSetPlay() {
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    desk.reach("PLAYING");
    desk.openFold();
    auto* formation = desk.dock->findChild<QComboBox*>("refereeFormation");
    formation->setCurrentIndex(formation->findText("Corner kick"));
    auto* with = desk.dock->findChild<QCheckBox*>("refereeAsSetPlay");
    QTest::mouseClick(with, Qt::LeftButton, {}, QPoint(8, with->height() / 2));
    QVERIFY(with->isChecked());
    QTRY_COMPARE(desk.undo()->count(), 3);
    const int before = desk.undo()->count();
    for (QPushButton* load : desk.dock->findChildren<QPushButton*>()) {
      if (load->text() == "Right attacks") QTest::mouseClick(load, Qt::LeftButton);
    }
    QTRY_COMPARE(desk.frame().referee->setPlay, std::string("corner kick"));
    QCOMPARE(desk.frame().referee->performingTeam, desk.frame().referee->teams[1].number);
    QTRY_COMPARE(desk.undo()->count(), before + 1);
    desk.undo()->undo();
    QTRY_COMPARE(desk.frame().referee->setPlay, std::string());
    QVERIFY(desk.errors.isEmpty());
  }

  void formationsAreOneStep() {
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    const auto before = desk.frame().robots;
    desk.openFold();
    auto* formation = desk.dock->findChild<QComboBox*>("refereeFormation");
    auto loads = desk.dock->findChildren<QPushButton*>();
    for (int i = 0; i < formation->count(); ++i) {
      formation->setCurrentIndex(i);
      for (QPushButton* load : loads) {
        if (load->text() == "Left attacks") QTest::mouseClick(load, Qt::LeftButton);
      }
      QTRY_COMPARE(desk.undo()->count(), 1);
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

  void whoIsPenalisedIsLeftOutOfAFormation() {
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    desk.openFold();
    desk.choose(1);
    desk.press("Penalise");
    QTRY_VERIFY(desk.frame().robots[1].penalty.has_value());
    const auto before = desk.frame().robots;
    auto* hasText = desk.dock->findChild<QLabel*>("refereeStaysOff");
    QTRY_COMPARE(hasText->text(), QString("B2 is penalised and stays off the field."));
    for (QPushButton* load : desk.dock->findChildren<QPushButton*>()) {
      if (load->text() == "Left attacks") QTest::mouseClick(load, Qt::LeftButton);
    }
    QTRY_VERIFY(desk.frame().robots[2].pose != before[2].pose);
    QCOMPARE(desk.frame().robots[1].pose, before[1].pose);
  }

  void rulesCanBeChosen() {
    Desk desk;
    QTRY_COMPARE(desk.state(), QString("INITIAL"));
    auto* rules = desk.dock->findChild<QComboBox*>("refereeRules");
    QTRY_COMPARE(rules->currentData().toString(), QString("humanoid-2021"));
    rules->setCurrentIndex(0);
    emit rules->activated(0);
    QTRY_VERIFY(!desk.frame().referee);
    QTRY_VERIFY(!desk.button("READY")->isVisible());
    QVERIFY(rules->isVisible());  // without a referee the fold is open
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
    desk.reach("PLAYING");
    desk.press("Goal right");
    QTRY_COMPARE(desk.state(), QString("READY"));
    desk.press("SET");
    desk.press("PLAYING");
    QTRY_COMPARE(desk.state(), QString("PLAYING"));
    QTRY_COMPARE(scoreboardOf(desk.frame()).right, 1);
    desk.choose(0);
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
    QTRY_COMPARE(stack->count(), steps + 1);
    const auto reported = [&desk] {
      return std::ranges::count_if(desk.timeline.events()->events(), [](const auto& event) {
        return event.kind == link::MatchEventKind::SettingChanged && event.detail == "rules";
      });
    };
    QTRY_COMPARE(reported(), 1);
    stack->undo();
    QTRY_COMPARE(reported(), 0);
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
    QTRY_VERIFY(automatic->isEnabled());
    automatic->click();
    QTRY_VERIFY(desk.frame().refereedGame->rules.automatic);
    QTRY_COMPARE(desk.undo()->count(), 1);
    const auto& events = desk.timeline.events()->events();
    QTRY_COMPARE(
        std::ranges::count(events, link::MatchEventKind::SettingChanged, &link::MatchEvent::kind),
        1);
    desk.undo()->undo();
    QTRY_VERIFY(!desk.frame().refereedGame->rules.automatic);
    QTRY_VERIFY(!automatic->isChecked());
  }
};

PITCHBOARD_GUI_TEST(TestRefereeRules)

}  // namespace tst_referee_rules

#include "tst_referee_rules.moc"
