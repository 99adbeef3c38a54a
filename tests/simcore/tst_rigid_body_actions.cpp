// SPDX-License-Identifier: GPL-3.0-or-later
#include <QtTest>

#include <simcore/world/action_codes.h>

#include "rigid_body_rig.h"

namespace tst_rigid_body_actions {

using namespace rig;

class TestRigidBodyActions : public QObject {
  Q_OBJECT

 private slots:
  void steadySpeed_data() {
    // system.md section 3 by hand: 0.30 cm per frame · 60 frames/s = 0.18 m/s; 0.30° · 60 = 18°/s.
    QTest::addColumn<int>("action");
    QTest::addColumn<int>("b");
    QTest::addColumn<double>("forward");
    QTest::addColumn<double>("left");
    QTest::addColumn<double>("turnDegrees");
    QTest::addColumn<bool>("moving");
    const auto row = [](const char* name, int action, int b, double forward, double left,
                        double turn, bool moving) {
      QTest::newRow(name) << action << b << forward << left << turn << moving;
    };
    row("stop", 0, 0, 0, 0, 0, false);
    row("forward fast", 1, 0, 0.18, 0, 0, true);
    row("turn left", 2, 0, 0, 0, 18, true);
    row("turn right", 3, 0, 0, 0, -18, true);
    row("walk left", 6, 0, 0, 0.12, 0, true);
    row("walk right", 7, 0, 0, -0.12, 0, true);
    row("forward slow, B 10", 8, 10, 0.09, 0, 0, true);
    row("forward slow, B 50", 8, 50, 0.09, 0, 0, true);
    row("forward slow, B 4", 8, 4, 0.036, 0, 0, true);
    row("forward slow, B 0", 8, 0, 0, 0, 0, true);
    row("forward slow, B -5", 8, -5, -0.045, 0, 0, true);
    row("around left", 9, 0, 0, 0.09, -18, true);
    row("goalkeeper", 10, 0, 0, 0, 0, true);
    row("gait", 11, 0, 0, 0, 0, true);
    row("around right", 14, 0, 0, -0.09, 18, true);
    row("get up, standing", 15, 0, 0, 0, 0, false);
    row("get up back, standing", 16, 0, 0, 0, 0, false);
    row("backward fast", 17, 0, -0.18, 0, 0, true);
    row("backward slow", 18, 0, -0.09, 0, 0, true);
    row("greetings", 19, 0, 0, 0, 0, true);
    row("goodbye", 20, 0, 0, 0, 0, true);
    row("unknown", 42, 0, 0, 0, 0, false);
    row("unknown negative", -1, 0, 0, 0, 0, false);
  }
  void steadySpeed() {
    QFETCH(int, action);
    QFETCH(int, b);
    QFETCH(double, forward);
    QFETCH(double, left);
    QFETCH(double, turnDegrees);
    QFETCH(bool, moving);
    for (const double rate : {10.0, 60.0, 1000.0}) {
      Rig r(atRate(rate));
      r.add({{-2, 1}, 0.6});
      r.placeBall(2, -2);
      r.commands[0].actionA = action;
      r.commands[0].actionB = b;
      r.run(1.0);
      const Pose before = r.robot().pose;
      r.step();
      const Pose after = r.robot().pose;
      const double dx = (after.position.x - before.position.x) * rate;
      const double dy = (after.position.y - before.position.y) * rate;
      const double c = std::cos(after.yaw), s = std::sin(after.yaw);
      QVERIFY(std::abs(c * dx + s * dy - forward) < 1e-9);
      QVERIFY(std::abs(c * dy - s * dx - left) < 1e-9);
      QVERIFY(std::abs((after.yaw - before.yaw) * rate / degree - turnDegrees) < 1e-6);
      QCOMPARE(r.percepts[0].control.moving, std::optional<int>(moving ? 1 : 0));
      QCOMPARE(r.percepts[0].control.action, action);
    }
  }

  void speedIsReachedWithinTheAcceleration() {
    Rig r;
    r.add({{-2, 1}, 0});
    r.placeBall(2, -2);
    r.commands[0].actionA = 1;
    double last = 0.0;
    for (int i = 0; i < 20; ++i) {
      r.step();
      QVERIFY(r.robot().forwardSpeed - last <= 1.0 / 60.0 + 1e-12);
      last = r.robot().forwardSpeed;
      if (i == 5) QVERIFY(std::abs(last - 0.1) < 1e-12);  // 6 ticks of 1 m/s² / 60
    }
    QVERIFY(std::abs(last - 0.18) < 1e-12);
  }

  void bIsReadWhenTheActionIsChosen() {
    Rig r;
    r.add({{-2, 1}, 0});
    r.placeBall(2, -2);
    r.commands[0].actionA = 8;
    r.commands[0].actionB = 4;
    r.run(0.5);
    r.commands[0].actionB = 10;
    r.run(0.5);
    QVERIFY(std::abs(r.robot().forwardSpeed - 0.036) < 1e-12);
    r.commands[0].actionA = 11;
    r.step();
    r.commands[0].actionA = 8;
    r.run(0.5);
    QVERIFY(std::abs(r.robot().forwardSpeed - 0.09) < 1e-12);
  }

  void unknownActionsAreCountedWhenChosen() {
    Rig r;
    r.add({{-2, 1}, 0});
    r.placeBall(2, -2);
    r.commands[0].actionA = 42;
    r.step();
    QCOMPARE(r.simulation.events().size(), std::size_t{1});
    QCOMPARE(r.simulation.events()[0].kind, EventKind::UnknownAction);
    QCOMPARE(r.simulation.events()[0].value, 42);
    r.step(10);
    QCOMPARE(r.simulation.state().statistics[0].unknownActions, 1U);
    r.commands[0].actionA = 1;
    r.step();
    r.commands[0].actionA = 42;
    r.step();
    QCOMPARE(r.simulation.state().statistics[0].unknownActions, 2U);
    QCOMPARE(r.simulation.state().statistics[0].lastUnknownAction, 42);
  }

  void kick_data() {
    // Force by hand: min(10, L·exp(−((13 − d)/L)²)) cm/frame, · 0.6 = m/s. At d = 25 cm, L = 12:
    // 12·e^−1 = 4.41455 → 2.64873 m/s; L = 8: 8·exp(−2.25) = 0.843194 → 0.505916 m/s. At d = 22.5:
    // L = 12: 12·exp(−0.626736) = 6.41200 → 3.84720 m/s. The right kick reaches from 30° right to
    // 5° left of the heading, the left one is its mirror image, passes 30° to both sides.
    QTest::addColumn<int>("action");
    QTest::addColumn<double>("distance_cm");
    QTest::addColumn<double>("bearing");
    QTest::addColumn<double>("speed");
    QTest::addColumn<double>("direction");
    const auto row = [](const char* name, int action, double d, double bearing, double speed,
                        double direction) {
      QTest::newRow(name) << action << d << bearing << speed << direction;
    };
    row("right, ahead", 4, 25, 0, 2.648731, 0);
    row("right, near", 4, 22.5, 0, 3.847197, 0);
    row("right, 29° right", 4, 25, -29, 2.648731, 0);
    row("right, 31° right", 4, 25, -31, 0, 0);
    row("right, 4° left", 4, 25, 4, 2.648731, 0);
    row("right, 6° left", 4, 25, 6, 0, 0);
    row("left, 29° left", 5, 25, 29, 2.648731, 0);
    row("left, 31° left", 5, 25, 31, 0, 0);
    row("left, 4° right", 5, 25, -4, 2.648731, 0);
    row("left, 6° right", 5, 25, -6, 0, 0);
    row("pass left", 12, 25, 29, 0.505916, 90);
    row("pass right", 13, 25, -29, 0.505916, -90);
    row("pass left, beside", 12, 25, 31, 0, 0);
    row("weak right", 21, 25, -10, 1.324366, 0);
    row("weak left", 22, 25, 10, 1.324366, 0);
    row("weak left, wrong side", 22, 25, -10, 0, 0);
    row("out of reach", 4, 100, 0, 0, 0);
    row("behind", 4, 25, 180, 0, 0);
  }
  void kick() {
    QFETCH(int, action);
    QFETCH(double, distance_cm);
    QFETCH(double, bearing);
    QFETCH(double, speed);
    QFETCH(double, direction);
    for (const double yaw : {0.0, 2.0, -pi + 0.01}) {
      Rig r;
      r.add({{-1, 0.5}, yaw});
      const double at = yaw + bearing * degree;
      r.placeBall(-1 + distance_cm / 100 * std::cos(at), 0.5 + distance_cm / 100 * std::sin(at));
      r.commands[0].actionA = action;
      r.step();
      QCOMPARE(r.percepts[0].control.finishedAction, std::optional<int>(action));
      QCOMPARE(r.percepts[0].control.moving, std::optional<int>(0));
      QCOMPARE(r.robot().action, 0);
      // The ball has rolled for one tick: it keeps 0.95 of its speed.
      QVERIFY(std::abs(r.ball().velocity.x - 0.95 * speed * std::cos(yaw + direction * degree)) <
              2e-6);
      QVERIFY(std::abs(r.ball().velocity.y - 0.95 * speed * std::sin(yaw + direction * degree)) <
              2e-6);
      QCOMPARE(r.simulation.state().statistics[0].kicks, speed > 0 ? 1U : 0U);
      QCOMPARE(r.simulation.events().size(), speed > 0 ? std::size_t{1} : std::size_t{0});
    }
  }

  void kickInterruptsWalking() {
    Rig r;
    r.add({{-1, 0}, 0});
    r.placeBall(-0.7, 0);
    r.commands[0].actionA = 11;
    r.step();
    r.commands[0].actionA = 4;
    r.step();
    QVERIFY(r.ball().velocity.x > 0.5);
  }

  void distanceWalkedIsCounted() {
    Rig r;
    r.add({{-2, 1}, 0});
    r.placeBall(2, -2);
    r.commands[0].actionA = 1;
    r.run(10.0);
    const double way = r.robot().pose.position.x + 2.0;
    QVERIFY(std::abs(r.simulation.state().statistics[0].distanceWalked - way) < 1e-9);
    r.commands[0].actionA = 0;
    r.run(1.0);
    r.place(1, {{2, 2}, 0});
    r.run(1.0);
    QVERIFY(r.simulation.state().statistics[0].distanceWalked < way + 1e-9);
  }

  void describesTheRobot() {
    Rig r;
    r.add({{-2, 1}, 1.0});
    r.placeBall(2, -2);
    (void)r.simulation.placeHead({1}, 1.5);
    r.commands[0].actionA = 1;
    r.run(1.0);
    const Snapshot snapshot = r.simulation.snapshot();
    QVERIFY(std::abs(snapshot.robots[0].headYaw - 1.5) < 1e-9);
    QVERIFY(std::abs(snapshot.robots[0].velocity.x - 0.18 * std::cos(1.0)) < 1e-9);
    QCOMPARE(snapshot.robots[0].action, 1);
    QVERIFY(!snapshot.robots[0].fallen);
    (void)r.simulation.placeHead({1}, 1.0 + pi);  // beyond the limit of the neck
    QVERIFY(std::abs(std::abs(r.robot().headYaw) - 135 * degree) < 1e-9);
  }

  void actionsHaveLabels() {
    QCOMPARE(actionLabel(0), std::string("stop"));
    QCOMPARE(actionLabel(22), std::string("kick left, weak"));
    QCOMPARE(actionLabel(23), std::string("action 23"));
    QCOMPARE(actionLabel(-1), std::string("action -1"));
  }
};

PITCHBOARD_TEST(TestRigidBodyActions)

}  // namespace tst_rigid_body_actions

#include "tst_rigid_body_actions.moc"
