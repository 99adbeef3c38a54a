// SPDX-License-Identifier: GPL-3.0-or-later
// Menus, editors and layers of the field, with real mouse and keyboard events.

#include <QAction>
#include <QDoubleSpinBox>
#include <QHelpEvent>
#include <QSignalSpy>
#include <QTest>
#include <QToolTip>
#include <QUndoStack>

#include <cmath>

#include <base/angles.h>
#include <robotlink/scenario/scenario.h>
#include <ui/base/referee_text.h>
#include <ui/field/field_view.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/referee_calls.h>

#include "../support/robot_keys.h"
#include "field_rig.h"

namespace tst_field_menus {

using namespace pitchboard;
using namespace pitchboard::ui;

class TestFieldMenus : public QObject, protected field_rig::FieldRig {
  Q_OBJECT
 private slots:
  void init() { open(); }
  void cleanup() { close(); }

  void menuOfARobotCommandsIt_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<int>("action");
    QTest::newRow("kick left") << "Kick left" << 5;
    QTest::newRow("kick right") << "Kick right" << 4;
    QTest::newRow("pass left") << "Pass left" << 12;
    QTest::newRow("pass right") << "Pass right" << 13;
    QTest::newRow("walk") << "Walk forward, fast" << 1;
    QTest::newRow("greet") << "Greetings" << 19;
  }
  void menuOfARobotCommandsIt() {
    QFETCH(QString, text);
    QFETCH(int, action);
    QVERIFY(trigger(pose(1).position, text));
    QCOMPARE(m_view->selection(), std::vector{inSlot(1)});
    QTRY_COMPARE(m_controller->frame()->robots.front().decided.value_or(-1), action);
  }

  void menuOfARobotRemovesAndFollows() {
    QVERIFY(trigger(pose(2).position, "Follow"));
    QCOMPARE(m_view->followed(), std::optional(inSlot(2)));
    QVERIFY(trigger(pose(2).position, "Remove robot"));
    QTRY_COMPARE(m_controller->frame()->robots.size(), std::size_t(5));
    QVERIFY(!m_view->followed());
  }

  void menuOfTheGroundPlacesTheBallAndRobots() {
    const Point place{1.0, 2.0};
    QVERIFY(trigger(place, "Place ball here"));
    QTRY_VERIFY(std::abs(m_controller->frame()->snapshot.ball.x - 1.0) < 0.03);
    QVERIFY(trigger({-1.0, -2.0}, "Red"));
    QTRY_COMPARE(m_controller->frame()->robots.size(), std::size_t(7));
    QCOMPARE(int(m_controller->frame()->robots.back().identity.team), int(TeamColor::Red));
    QTRY_COMPARE(m_controller->edits()->undoStack()->count(), 2);
  }

  void theRefereeIsInTheMenus() {
    const auto penalty = [this](std::size_t robot) {
      const auto& is = m_controller->frame()->robots[robot].penalty;
      return is ? labelText(is->kind) : QString();
    };
    QVERIFY(!trigger(pose(1).position, "Pardon"));  // this match has no referee
    chooseReferee(m_controller->edits(), "humanoid-2021", "rules");
    QTRY_VERIFY(m_controller->frame()->game);
    // What is not allowed is grey and says why.
    const auto why = [this](const Point& place, const char* text) {
      auto* menu = menuAt(place);
      const QAction* found = menu_entry::called(menu->findChildren<QAction*>(), text);
      const QString tip = found != nullptr && !found->isEnabled() ? found->toolTip() : QString();
      menu->close();
      return tip;
    };
    QCOMPARE(why(pose(2).position, "Pardon"), QString("B2 is not penalised."));
    QCOMPARE(why({1.0, 2.0}, "Goal for BLUE"),
             QString("A goal counts only in PLAYING or FINISHED."));
    QVERIFY(trigger(pose(2).position, "Pickup or incapable"));
    QTRY_COMPARE(penalty(1), QString("pickup or incapable"));
    QVERIFY(trigger(pose(2).position, "Pardon"));
    QTRY_COMPARE(penalty(1), QString());
    QVERIFY(trigger(pose(3).position, "Red card"));
    QTRY_COMPARE(penalty(2), QString("sent off"));
    for (const auto state : {PlayState::Ready, PlayState::Set, PlayState::Playing}) {
      callReferee(m_controller->edits(), {.kind = sim::CallKind::State, .state = state}, "state");
    }
    QTRY_COMPARE(m_controller->frame()->game->state, PlayState::Playing);
    QVERIFY(trigger({1.0, 2.0}, "Left penalty mark"));
    QTRY_VERIFY(m_controller->frame()->snapshot.ball.x < -1.0);
    QVERIFY(trigger({1.0, 2.0}, "Goal for RED"));
    QTRY_COMPARE(m_controller->frame()->snapshot.score.right, 1);
    QTRY_COMPARE(m_controller->edits()->undoStack()->undoText(), QString("Goal for RED"));
  }

  void menuOfARobotChangesItsBehaviour() {
    QVERIFY(trigger(pose(3).position, "Keeper"));
    QTRY_COMPARE(m_controller->frame()->robots[2].behaviour, std::string("keeper"));
    QCOMPARE(m_controller->edits()->robot(RobotId{3})->behaviour, std::string("keeper"));
    QVERIFY(isChecked(pose(3).position, "Keeper"));
    QVERIFY(!isChecked(pose(3).position, "Striker"));
    QVERIFY(trigger(pose(3).position, "None (team program)"));
    QTRY_COMPARE(m_controller->frame()->robots[2].behaviour, std::string(link::noBehaviour));
  }

  void menuOfARobotChangesItsTeam() {
    const Pose before = pose(1);
    QVERIFY(isChecked(before.position, "Blue"));
    QVERIFY(trigger(before.position, "Red"));
    const auto identity = [this](int id) {
      const link::RobotFrame* robot = m_controller->frame()->robot(RobotId{id});
      return robot != nullptr ? robot->identity : sim::RobotIdentity{};
    };
    QTRY_COMPARE(int(identity(1).team), int(TeamColor::Red));
    QCOMPARE(identity(1).number, 4);      // 1 to 3 are worn
    QVERIFY(identity(1).imuStartsAt180);  // it attacks to the left now
    QVERIFY(near(pose(1), before));
    QTRY_COMPARE(m_controller->edits()->undoStack()->undoText(), QString("Move B1 to team red"));
    QVERIFY(trigger(before.position, "Red"));  // is there already
    QTRY_COMPARE(m_controller->edits()->undoStack()->count(), 1);
    m_controller->edits()->undoStack()->undo();
    QTRY_COMPARE(int(identity(1).team), int(TeamColor::Blue));
    QCOMPARE(identity(1).number, 1);
    QVERIFY(!identity(1).imuStartsAt180);
    m_controller->edits()->undoStack()->redo();
    QTRY_COMPARE(int(identity(1).team), int(TeamColor::Red));
    QCOMPARE(int(m_controller->currentMoment().robots[0].identity.team), int(TeamColor::Red));
  }

  void selectedRobotsChangeTeamTogether() {
    m_view->select({inSlot(1), inSlot(2), inSlot(4)});
    QVERIFY(trigger(pose(1).position, "Orange"));
    const auto inOrange = [this] {
      int count = 0;
      for (const auto& robot : m_controller->frame()->robots) {
        count += robot.identity.team == TeamColor::Orange;
      }
      return count;
    };
    QTRY_COMPARE(inOrange(), 3);
    m_controller->edits()->undoStack()->undo();
    QTRY_COMPARE(inOrange(), 0);
  }

  void menuAsksToSaveTheMoment() {
    const QSignalSpy save(m_view.get(), &FieldView::saveScenarioRequested);
    QVERIFY(trigger({-1.0, -2.0}, "Save this moment as a scenario…"));
    QCOMPARE(save.count(), 1);
  }

  void poseEditorKeepsOrPutsBack_data() {
    QTest::addColumn<int>("key");
    QTest::addColumn<int>("commands");
    QTest::newRow("Enter applies") << int(Qt::Key_Return) << 1;
    QTest::newRow("Esc reverts") << int(Qt::Key_Escape) << 0;
  }
  void poseEditorKeepsOrPutsBack() {
    QFETCH(int, key);
    QFETCH(int, commands);
    const Pose before = pose(1);
    QTest::mouseDClick(m_canvas->viewport(), Qt::LeftButton, {}, at(before.position));
    auto* x = m_view->findChild<QDoubleSpinBox*>("x");
    auto* heading = m_view->findChild<QDoubleSpinBox*>("heading");
    QVERIFY(x && heading);
    x->setValue(0.75);
    heading->setValue(90.0);
    // While it is typed, only the scene shows it.
    QCOMPARE(pose(1).position, before.position);
    QTest::keyClick(x, Qt::Key(key));
    QTRY_COMPARE(m_controller->edits()->undoStack()->count(), commands);
    const Pose after = commands ? Pose{{0.75, before.position.y}, radiansFromDegrees(90)} : before;
    QTRY_VERIFY(near(pose(1), after) && std::abs(wrapToPi(pose(1).yaw - after.yaw)) < 1e-6);
    QTRY_VERIFY(!m_view->findChild<QDoubleSpinBox*>("x"));
    if (!commands) return;
    m_controller->edits()->undoStack()->undo();
    QTRY_VERIFY(near(pose(1), before));
  }

  void menuOfARobotChangesItsNumberAndModel() {
    QVERIFY(isChecked(pose(1).position, "1"));
    QVERIFY(trigger(pose(1).position, "7"));
    QTRY_COMPARE(m_controller->frame()->robots[0].identity.number, 7);
    QVERIFY(isChecked(pose(1).position, "Published robot"));
    QVERIFY(trigger(pose(1).position, "Kid size"));
    QTRY_COMPARE(m_controller->frame()->robots[0].radius, 0.19);
    m_controller->edits()->undoStack()->undo();
    QTRY_COMPARE(m_controller->frame()->robots[0].radius, 0.0);
  }

  void ballEditorSetsPlaceAndSpeed() {
    const Point before = m_controller->frame()->snapshot.ball;
    QVERIFY(trigger(before, "Ball position and speed…"));
    auto* speed = m_view->findChild<QDoubleSpinBox*>("speed");
    auto* heading = m_view->findChild<QDoubleSpinBox*>("heading");
    QVERIFY(speed && heading);
    speed->setValue(1.5);
    heading->setValue(90.0);
    QTest::keyClick(speed, Qt::Key_Return);
    QTRY_VERIFY(std::abs(m_controller->frame()->snapshot.ballVelocity.y - 1.5) < 1e-6);
    QVERIFY(std::abs(m_controller->frame()->snapshot.ball.y - before.y) < 1e-6);
  }

  // As a robot's: the hand says that it can be dragged, a double click opens its numbers.
  void theBallAnswersTheMouse() {
    const Point ball = m_controller->frame()->snapshot.ball;
    const QPoint place = at(ball);
    moveTo(place, Qt::NoButton);
    QCOMPARE(m_canvas->viewport()->cursor().shape(), Qt::OpenHandCursor);
    QHelpEvent help(QEvent::ToolTip, place, m_canvas->viewport()->mapToGlobal(place));
    QCoreApplication::sendEvent(m_canvas->viewport(), &help);
    QVERIFY2(QToolTip::text().startsWith(QStringLiteral("Ball")), qPrintable(QToolTip::text()));
    QVERIFY(QToolTip::text().contains(QStringLiteral("m/s")));
    QToolTip::hideText();
    QTest::mouseDClick(m_canvas->viewport(), Qt::LeftButton, {}, place);
    auto* x = m_view->findChild<QDoubleSpinBox*>("x");
    QVERIFY(x && m_view->findChild<QDoubleSpinBox*>("speed"));
    x->setValue(1.25);
    QTest::keyClick(x, Qt::Key_Return);
    QTRY_VERIFY(std::abs(m_controller->frame()->snapshot.ball.x - 1.25) < 1e-6);
    QTRY_COMPARE(m_controller->edits()->undoStack()->count(), 1);
  }

  void ballEditorTakesACommaAndIsUndone() {
    const Point before = m_controller->frame()->snapshot.ball;
    QVERIFY(trigger(before, "Ball position and speed…"));
    auto* y = m_view->findChild<QDoubleSpinBox*>("y");
    QVERIFY(y);
    // With a decimal comma, by its keys.
    y->selectAll();
    QTest::keyClicks(y, QStringLiteral("-1,25"));
    QTest::keyClick(y, Qt::Key_Return);
    QTRY_VERIFY(std::abs(m_controller->frame()->snapshot.ball.y + 1.25) < 1e-6);
    QTRY_COMPARE(m_controller->edits()->undoStack()->count(), 1);
    m_controller->edits()->undoStack()->undo();
    QTRY_VERIFY(std::abs(m_controller->frame()->snapshot.ball.y - before.y) < 1e-6);
  }

  void layerOptionsChangeThePicture() {
    const auto options = m_view->actions().options;
    QCOMPARE(options.size(), std::size_t(4));
    const QSize size(640, 455);
    const QImage one = m_view->picture(size);
    options[0]->setChecked(true);  // fields of view of robots that are not selected
    const QImage all = m_view->picture(size);
    QVERIFY(all != one);
    m_view->select({inSlot(1)});
    m_view->actions().layers[std::size_t(FieldLayer::Eopra)]->setChecked(true);
    const QImage four = m_view->picture(size);
    options[2]->setChecked(true);
    QVERIFY(!options[1]->isChecked());
    QVERIFY(m_view->picture(size) != four);
  }

  void particlesAndPathAreDrawnIfRobotsSendThem() {
    auto frame = std::make_shared<link::MatchFrame>(*m_controller->frame());
    auto cloud = std::make_shared<link::ParticleCloud>();
    for (int i = 0; i < 200; ++i) cloud->particles.push_back({{-3.0 + 0.01 * i, 2.0}, 0.5, 0.005});
    auto path = std::make_shared<link::PlannedPath>();
    path->points = {{-1.0, -2.0}, {0.0, -2.5}, {2.0, -2.0}};
    frame->robots.at(0).cognitionDebug = {RobotId{1}, cloud, path, 0.0, 0.0};
    QCOMPARE(frame->robots[0].key, blue(1));
    FieldView view(nullptr);
    view.resize(900, 660);
    view.showFrame(frame);
    const QSize size(1040, 740);
    const QImage without = view.picture(size);
    for (const FieldLayer layer : {FieldLayer::Particles, FieldLayer::PlannedPath}) {
      QAction* action = view.actions().layers[std::size_t(layer)];
      QVERIFY(!action->isChecked());  // off at first
      action->setChecked(true);
      QVERIFY(view.picture(size) != without);
      view.select({inSlot(2)});  // of selected robots only, and this one tells nothing
      const QImage other = view.picture(size);
      view.select({inSlot(1)});
      QVERIFY(view.picture(size) != other);
      view.select({});
      action->setChecked(false);
      QCOMPARE(view.picture(size), without);
    }
    auto silent = std::make_shared<link::MatchFrame>(*frame);
    silent->robots[0].cognitionDebug.reset();
    view.actions().layers[std::size_t(FieldLayer::Particles)]->setChecked(true);
    view.actions().layers[std::size_t(FieldLayer::PlannedPath)]->setChecked(true);
    view.showFrame(silent);
    QCOMPARE(view.picture(size), without);
  }
};

PITCHBOARD_GUI_TEST(TestFieldMenus)

}  // namespace tst_field_menus

#include "tst_field_menus.moc"
