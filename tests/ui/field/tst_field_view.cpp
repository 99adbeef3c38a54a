// SPDX-License-Identifier: GPL-3.0-or-later
// The field with real mouse and keyboard events on a real match that stands still.

#include <QAction>
#include <QGraphicsView>
#include <QKeyEvent>
#include <QSignalSpy>
#include <QTest>
#include <QUndoStack>

#include <algorithm>
#include <atomic>
#include <cmath>

#include <base/angles.h>
#include <robotlink/blackboard/robot_variables.h>
#include <robotlink/blackboard/system_v.h>
#include <robotlink/scenario/scenario.h>
#include <ui/base/theme.h>
#include <ui/field/field_keys.h>
#include <ui/field/field_view.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>

#include "../support/robot_keys.h"
#include "../support/segment_keys.h"
#include "field_rig.h"

namespace tst_field_view {

using namespace pitchboard;
using namespace pitchboard::ui;

class TestFieldView : public QObject, protected field_rig::FieldRig {
  Q_OBJECT

  /// A published key, as the window hands it on.
  void press(int key, Qt::KeyboardModifiers modifiers = {}) {
    QVERIFY(m_view->takePublishedKey(QKeyEvent(QEvent::KeyPress, key, modifiers)));
  }

 private slots:
  void init() { open(); }
  void cleanup() { close(); }

  void dragMovesTheRobotInTheWorldAndCanBeUndone() {
    const Pose before = pose(1);
    const QPoint from = at(before.position);
    const QPoint to = from + QPoint(80, -40);
    drag(from, to);
    const QPointF target = metres(to) - metres(from);
    QTRY_VERIFY(std::abs(pose(1).position.x - before.position.x - target.x()) < 0.03);
    QVERIFY(std::abs(pose(1).position.y - before.position.y - target.y()) < 0.03);
    QTRY_COMPARE(m_controller->edits()->undoStack()->count(), 1);
    m_controller->edits()->undoStack()->undo();
    QTRY_VERIFY(near(pose(1), before));
    m_controller->edits()->undoStack()->redo();
    QTRY_VERIFY(std::abs(pose(1).position.x - before.position.x - target.x()) < 0.03);
  }

  void dragMovesTheBall() {
    const Point before = m_controller->frame()->snapshot.ball;
    const QPoint from = at(before);
    drag(from, from + QPoint(60, 60));
    QTRY_VERIFY(m_controller->frame()->snapshot.ball.y < before.y - 0.3);
    m_controller->edits()->undoStack()->undo();
    QTRY_VERIFY(std::abs(m_controller->frame()->snapshot.ball.y - before.y) < 1e-6);
  }

  // From the mouse to the segment that a team's own process reads.
  void aDragWhileTheMatchPlaysReachesTheBlackboard() {
    link::MatchOptions options;
    options.cognition = link::Cognition::None;
    options.keyBase = testKeyBase();
    MatchController controller(options);
    FieldView view(&controller);
    view.resize(900, 660);
    view.show();
    QVERIFY(QTest::qWaitForWindowExposed(&view));
    auto scenario = link::loadScenario("one-robot");
    QVERIFY(scenario);
    scenario->robots[0].behaviour = link::noBehaviour;
    controller.open(*scenario, false);
    QTRY_VERIFY(controller.frame() && controller.frame()->robots.size() == 1);
    const auto board = link::SystemVSegments::open(
        link::blackboardKey(RobotId{1}, options.keyBase.value()), link::AttachMode::AttachOnly);
    QVERIFY2(board, board ? "" : board.error().text().c_str());
    const link::RobotVariables v;
    const auto yaw = [&] { return static_cast<double>(board->read(v.imuEulerZ)); };
    const auto ballDistance = [&] { return static_cast<double>(board->read(v.visionBallDist)); };
    QTRY_VERIFY(std::abs(ballDistance() - 150.0) < 1.0);
    auto* canvas = view.findChild<QGraphicsView*>();
    const auto onScreen = [&](const Point& p) {
      return canvas->viewportTransform().map(QPointF(p.x, p.y)).toPoint();
    };
    const auto dragOn = [&](QPoint from, QPoint to, Qt::KeyboardModifiers keys) {
      QTest::mousePress(canvas->viewport(), Qt::LeftButton, keys, from);
      for (const QPoint point : {(from + to) / 2, to}) {
        QMouseEvent move(QEvent::MouseMove, QPointF(point),
                         canvas->viewport()->mapToGlobal(QPointF(point)), Qt::NoButton,
                         Qt::LeftButton, keys);
        QCoreApplication::sendEvent(canvas->viewport(), &move);
      }
      QTest::mouseRelease(canvas->viewport(), Qt::LeftButton, keys, to);
    };
    // Half a metre nearer to the ball, then a third of a turn: the match goes on all the while.
    dragOn(onScreen({-1.5, 0.0}), onScreen({-1.0, 0.0}), {});
    QTRY_VERIFY(std::abs(ballDistance() - 100.0) < 3.0);
    // What is dragged next is what the window shows, a frame later than the segment.
    QTRY_VERIFY(std::abs(controller.frame()->robots[0].pose.position.x + 1.0) < 0.05);
    dragOn(onScreen({-1.0, 0.0}), onScreen({-1.0, 1.0}), Qt::ShiftModifier);
    QTRY_VERIFY(std::abs(wrapToPi(yaw() - radiansFromDegrees(90))) < 0.06);
    QVERIFY(!controller.isPaused());
  }

  // What is held is only shown; the match is told once, when it is released.
  void aDragChangesNothingBeforeItIsReleased_data() {
    QTest::addColumn<bool>("ball");
    QTest::addColumn<bool>("released");
    QTest::newRow("a robot, released") << false << true;
    QTest::newRow("a robot, given up") << false << false;
    QTest::newRow("the ball, released") << true << true;
    QTest::newRow("the ball, given up") << true << false;
  }
  void aDragChangesNothingBeforeItIsReleased() {
    QFETCH(bool, ball);
    QFETCH(bool, released);
    struct Changes : link::TickObserver {
      std::atomic<int> count = 0;  // each of them is a checkpoint of a recording
      void ticked(const link::SimulatedMatch&, std::chrono::nanoseconds) override {}
      void worldChanged(const link::SimulatedMatch&) override { ++count; }
    };
    const auto changes = std::make_shared<Changes>();
    m_controller->settle();
    QVERIFY(m_controller->observe(changes));
    const std::uint64_t hash = m_controller->stateHash();
    const QUndoStack* undo = m_controller->edits()->undoStack();
    const QPoint from = at(ball ? m_controller->frame()->snapshot.ball : pose(1).position);
    const QPoint to = from + QPoint(70, 60);
    const QImage before = m_canvas->grab().toImage();
    QTest::mousePress(m_canvas->viewport(), Qt::LeftButton, {}, from);
    for (int i = 1; i <= 5; ++i) {
      moveTo(from + (to - from) * i / 5);
      QCOMPARE(m_controller->stateHash(), hash);
    }
    QVERIFY(m_canvas->grab(QRect(to, QSize(1, 1))).toImage() !=
            before.copy(QRect(to, QSize(1, 1))));
    if (!released) QVERIFY(m_view->cancel());
    QTest::mouseRelease(m_canvas->viewport(), Qt::LeftButton, {}, to);
    QTRY_COMPARE(undo->count(), released ? 1 : 0);
    QCOMPARE(m_controller->stateHash() == hash, !released);
    QCOMPARE(changes->count.load(), released ? 1 : 0);
    m_controller->stopObserving(changes);
  }

  void shiftDragTurns() {
    const Pose before = pose(1);
    const QPoint from = at(before.position);
    drag(from, from + QPoint(0, -60), Qt::ShiftModifier);
    QTRY_VERIFY(std::abs(wrapToPi(pose(1).yaw - radiansFromDegrees(90))) < 0.05);
    QVERIFY(std::abs(pose(1).position.x - before.position.x) < 1e-6);
  }

  void handleTurns() {
    m_view->select({inSlot(1)});
    const Pose before = pose(1);  // faces right: the handle lies to the right of the robot
    const double scale = m_canvas->transform().m11();
    const int reach = static_cast<int>(std::lround(std::max(0.13 * scale, 9.0) * 1.7 + 18));
    const QPoint centre = at(before.position);
    drag(centre + QPoint(reach, 0), centre + QPoint(0, reach));
    QTRY_VERIFY(std::abs(wrapToPi(pose(1).yaw + radiansFromDegrees(90))) < 0.06);
  }

  // Only one that is selected: who zooms over a crowd does not want to turn it.
  void wheelOverASelectedRobotTurnsIt() {
    const double scale = m_canvas->transform().m11();
    wheel(at(pose(1).position), 120);
    QVERIFY(m_canvas->transform().m11() > scale);
    m_view->actions().fit->trigger();
    m_view->select({inSlot(1)});
    wheel(at(pose(1).position), 120);
    QCOMPARE(m_canvas->transform().m11(), scale);
    QTRY_VERIFY(std::abs(pose(1).yaw - radiansFromDegrees(5)) < 1e-6);
  }

  void everyNotchOfTheWheelCounts() {
    m_view->select({inSlot(1)});
    for (int i = 0; i < 4; ++i) wheel(at(pose(1).position), 120);
    QTRY_VERIFY(std::abs(pose(1).yaw - radiansFromDegrees(20)) < 1e-6);
  }

  void wheelZoomKeepsThePointUnderTheCursor_data() {
    QTest::addColumn<QPoint>("point");
    QTest::addColumn<int>("delta");
    QTest::newRow("in") << QPoint(500, 150) << 240;
    QTest::newRow("out") << QPoint(200, 400) << -120;
    QTest::newRow("far in") << QPoint(333, 222) << 1200;
  }
  void wheelZoomKeepsThePointUnderTheCursor() {
    QFETCH(QPoint, point);
    QFETCH(int, delta);
    const QPointF before = metres(point);
    const double scale = m_canvas->transform().m11();
    wheel(point, delta);
    QVERIFY(std::abs(m_canvas->transform().m11() - scale) > 1);
    const QPointF shown = m_canvas->viewportTransform().map(before);
    QVERIFY2((shown - QPointF(point)).manhattanLength() <= 2.0, "the point moved on the screen");
    m_view->actions().fit->trigger();
    QCOMPARE(m_canvas->transform().m11(), scale);
  }

  void severalAreSelectedAndMovedTogether() {
    const QSignalSpy changed(m_view.get(), &FieldView::selectionChanged);
    QTest::mouseClick(m_canvas->viewport(), Qt::LeftButton, {}, at(pose(1).position));
    QTest::mouseClick(m_canvas->viewport(), Qt::LeftButton, Qt::ControlModifier,
                      at(pose(2).position));
    QCOMPARE(m_view->selection(), (std::vector{inSlot(1), inSlot(2)}));
    QCOMPARE(changed.count(), 2);
    const Pose one = pose(1), two = pose(2);
    drag(at(one.position), at(one.position) + QPoint(30, 0));
    QTRY_VERIFY(pose(1).position.x > one.position.x + 0.2);
    QTRY_VERIFY(pose(2).position.x > two.position.x + 0.2);
    QTRY_COMPARE(m_controller->edits()->undoStack()->count(), 1);
  }

  void aClickOnOneOfSeveralSelectsThatOne() {
    m_view->select({inSlot(1), inSlot(2)});
    QTest::mouseClick(m_canvas->viewport(), Qt::LeftButton, {}, at(pose(2).position));
    QCOMPARE(m_view->selection(), std::vector{inSlot(2)});
  }

  void rubberBandSelects() {
    drag(at({-4.6, 3.3}), at({-0.2, -3.3}));
    QCOMPARE(m_view->selection(), (std::vector{inSlot(1), inSlot(2), inSlot(3)}));
  }

  void everyNudgeCounts_data() {
    QTest::addColumn<bool>("flipped");
    QTest::addColumn<QPointF>("way");
    QTest::newRow("as drawn") << false << QPointF(0.01, -0.1);
    QTest::newRow("flipped") << true << QPointF(-0.01, 0.1);
  }
  void everyNudgeCounts() {
    QFETCH(bool, flipped);
    QFETCH(QPointF, way);
    m_view->setFlipped(flipped);
    m_view->select({inSlot(1)});
    const Pose before = pose(1);
    for (int i = 0; i < 3; ++i) m_view->nudge({0.01, -0.1});
    QTRY_VERIFY(std::abs(pose(1).position.x - before.position.x - 3 * way.x()) < 1e-6 &&
                std::abs(pose(1).position.y - before.position.y - 3 * way.y()) < 1e-6);
  }

  void removedRobotsAreSelectedNoMoreAndUndoBringsThemBack() {
    m_view->select({inSlot(4)});
    m_controller->edits()->removeRobots(m_controller->frame()->slotsOf({inSlot(4)}));
    QTRY_COMPARE(m_controller->frame()->robots.size(), std::size_t(5));
    QVERIFY(m_view->selection().empty());
    m_controller->edits()->undoStack()->undo();
    QTRY_COMPARE(m_controller->frame()->robots.size(), std::size_t(6));
  }

  void aAddsARobot_data() {
    QTest::addColumn<Qt::KeyboardModifiers>("modifiers");
    QTest::addColumn<int>("team");
    QTest::newRow("plain") << Qt::KeyboardModifiers() << int(TeamColor::Blue);
    QTest::newRow("Ctrl") << Qt::KeyboardModifiers(Qt::ControlModifier) << int(TeamColor::Red);
    QTest::newRow("Alt") << Qt::KeyboardModifiers(Qt::AltModifier) << int(TeamColor::Black);
    QTest::newRow("Shift") << Qt::KeyboardModifiers(Qt::ShiftModifier) << int(TeamColor::Yellow);
  }
  void aAddsARobot() {
    QFETCH(Qt::KeyboardModifiers, modifiers);
    QFETCH(int, team);
    moveTo(at({1.0, 1.5}));
    press(Qt::Key_A, modifiers);
    QTRY_COMPARE(m_controller->frame()->robots.size(), std::size_t(7));
    const sim::RobotSnapshot made = m_controller->frame()->robots.back();
    QCOMPARE(int(made.identity.team), team);
    QVERIFY(std::abs(made.pose.position.x - 1.0) < 0.03);
    QCOMPARE(std::abs(made.pose.yaw) > 1.0, info(made.identity.team).facesLeft);
  }

  void numbersSelect() {
    m_view->selectNumber(4);
    QCOMPARE(m_view->selection(), std::vector{inSlot(4)});
  }

  void flippingTurnsTheFieldRound() {
    const QPoint before = at({3.0, 1.0});
    m_view->actions().flip->trigger();
    QVERIFY(m_view->actions().flip->isChecked());
    const QPoint after = at({3.0, 1.0});
    const QPoint middle = m_canvas->viewport()->rect().center();
    QVERIFY(((after - middle) + (before - middle)).manhattanLength() <= 4);
  }

  void cursorIsReportedInMetres() {
    const QSignalSpy moved(m_view.get(), &FieldView::cursorMoved);
    moveTo(at({2.0, -1.0}));
    QVERIFY(!moved.isEmpty());
    const QPointF reported = moved.back().front().toPointF();
    QVERIFY(std::abs(reported.x() - 2.0) < 0.02 && std::abs(reported.y() + 1.0) < 0.02);
  }

  void functionKeysAsk() {
    const QSignalSpy load(m_view.get(), &FieldView::loadMatchRequested);
    const QSignalSpy reset(m_view.get(), &FieldView::resetRequested);
    const QSignalSpy clear(m_view.get(), &FieldView::clearRequested);
    for (const int key : {Qt::Key_F2, Qt::Key_F3, Qt::Key_F4}) press(key);
    QCOMPARE(load.count() + reset.count() + clear.count(), 3);
  }

  void pictureHasTheAskedSizeAndShowsRobots() {
    const QImage with = m_view->picture(QSize(640, 455));
    QCOMPARE(with.size(), QSize(640, 455));
    m_controller->edits()->removeRobots({RobotId{1}, RobotId{2}});
    QTRY_COMPARE(m_controller->frame()->robots.size(), std::size_t(4));
    QVERIFY(with != m_view->picture(QSize(640, 455)));
  }

  void theRightShiftKeyMakesOrangeRobots() {
    moveTo(at({1.0, 1.5}));
    constexpr quint32 rightShiftScanCode = 62;
    QKeyEvent shift(QEvent::KeyPress, Qt::Key_Shift, Qt::NoModifier, rightShiftScanCode, 0, 0);
    QVERIFY(!m_view->takePublishedKey(shift));
    press(Qt::Key_A, Qt::ShiftModifier);
    QTRY_COMPARE(m_controller->frame()->robots.size(), std::size_t(7));
    QCOMPARE(int(m_controller->frame()->robots.back().identity.team), int(TeamColor::Orange));
  }

  void aDragWhilePanIsHeldMovesTheViewAndReportsIt() {
    QVERIFY(!m_view->setPanHeld(true));
    QVERIFY(!m_view->setPanHeld(false));  // a tap
    const QPoint here = at({0.0, 0.0});
    m_view->setPanHeld(true);
    drag(here, here + QPoint(80, 30));
    QVERIFY(m_view->setPanHeld(false));
    QVERIFY((at({0.0, 0.0}) - here - QPoint(80, 30)).manhattanLength() <= 2);
  }

  void shiftDragOfTheBallKicksIt() {
    const Point before = m_controller->frame()->snapshot.ball;
    const QPoint from = at(before);
    drag(from, from + QPoint(60, 0), Qt::ShiftModifier);
    QTRY_VERIFY(m_controller->frame()->snapshot.ballVelocity.x > 0.5);
    const double metresDrawn = (metres(from + QPoint(60, 0)) - metres(from)).x();
    QVERIFY(std::abs(m_controller->frame()->snapshot.ballVelocity.x - 2 * metresDrawn) < 0.1);
    QVERIFY(std::abs(m_controller->frame()->snapshot.ball.x - before.x) < 1e-6);
    QTRY_COMPARE(m_controller->edits()->undoStack()->undoText(), QString("Kick the ball"));
    m_controller->edits()->undoStack()->undo();
    QTRY_COMPARE(m_controller->frame()->snapshot.ballVelocity.x, 0.0);
  }

  void aGroupKeepsItsFormationAtTheWall() {
    const Pose one = pose(1), two = pose(2);
    m_view->select({inSlot(1), inSlot(2)});
    const QPoint from = at(one.position);
    drag(from, QPoint(2, from.y()));
    QTRY_VERIFY(pose(1).position.x < one.position.x - 0.1);
    QTRY_VERIFY(std::abs(std::min(pose(1).position.x, pose(2).position.x) + 5.2 - 0.13) < 0.01);
    QVERIFY(std::abs(pose(1).position.x - pose(2).position.x - one.position.x + two.position.x) <
            1e-6);
  }

  /// The field fills it, and score and clock stand in it, however it is made.
  void onePictureHoweverItIsMade() {
    const QImage image =
        QImage::fromData(m_view->pictureFile({1280, 720}, QStringLiteral("png")), "png");
    QCOMPARE(image.size(), QSize(1012, 720));
    const QRgb border = theme().fieldBorder.rgb();
    for (const QPoint& corner :
         {QPoint(2, 2), QPoint(1009, 2), QPoint(2, 717), QPoint(1009, 717)}) {
      QCOMPARE(image.pixel(corner), border);
    }
    const auto caption = [](const QImage& picture) { return picture.copy(200, 4, 612, 56); };
    QImage empty = caption(image);
    empty.fill(border);
    QVERIFY(caption(image) != empty);
    const QImage film = m_view->framePainter()->paint(m_controller->frame(), image.size());
    QCOMPARE(film.convertToFormat(image.format()), image);
    // The clock of the match, not the time of the simulation.
    auto later = std::make_shared<link::MatchFrame>(*m_controller->frame());
    later->snapshot.time += 600;
    QVERIFY(caption(m_view->framePainter()->paint(later, image.size())) ==
            caption(image).convertToFormat(film.format()));
    later->snapshot.clock += 61;
    QVERIFY(caption(m_view->framePainter()->paint(later, image.size())) !=
            caption(image).convertToFormat(film.format()));
  }

  void nothingIsDrawnBesideThePlayingArea() {
    // A picture much wider than the field: with everything shown, its sides stay empty.
    for (QAction* layer : m_view->actions().layers) layer->setChecked(true);
    for (QAction* option : m_view->actions().options) option->setChecked(true);
    m_view->actions().layers[std::size_t(FieldLayer::Grid)]->setChecked(false);
    m_controller->edits()->moveRobots(
        {{RobotId{1}, pose(1), {{-4.9, 0.0}, radiansFromDegrees(180)}}});
    m_view->select({inSlot(1)});
    QTRY_VERIFY(pose(1).position.x < -4.8);
    const QImage image = m_view->picture(QSize(1400, 455));
    const QRgb ground = image.pixel(0, 0);
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < 300; ++x) QCOMPARE(image.pixel(x, y), ground);
    }
  }

  void withoutMatchNothingHappens() {
    FieldView alone(nullptr);
    alone.resize(400, 300);
    alone.show();
    QVERIFY(QTest::qWaitForWindowExposed(&alone));
    auto* canvas = alone.findChild<QGraphicsView*>();
    for (const FieldKey& key : fieldKeys()) {
      alone.takePublishedKey(QKeyEvent(QEvent::KeyPress, key.key, key.modifiers));
    }
    alone.nudge({0.01, 0});
    alone.selectNumber(1);
    QVERIFY(!alone.cancel());
    QTest::mouseClick(canvas->viewport(), Qt::LeftButton);
    alone.showFrame(nullptr);
    QVERIFY(alone.selection().empty());
  }
};

PITCHBOARD_GUI_TEST(TestFieldView)

}  // namespace tst_field_view

#include "tst_field_view.moc"
