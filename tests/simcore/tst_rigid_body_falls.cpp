// SPDX-License-Identifier: GPL-3.0-or-later
#include <QtTest>

#include "rigid_body_rig.h"

namespace tst_rigid_body_falls {

using namespace rig;

namespace {

SimulationSettings falling(bool on = true) {
  SimulationSettings settings;
  settings.rigidBody.falls = on;
  return settings;
}

/// A robot at the origin, hit by the ball from behind (it faces right) or from the front.
Rig hit(const SimulationSettings& settings, bool fromBehind, double speed = 10.0) {
  Rig r(settings);
  r.add({{0, 0}, 0});
  const double side = fromBehind ? -1.0 : 1.0;
  r.placeBall(0.4 * side, 0, -speed * side, 0);
  return r;
}

int count(const Rig& r, EventKind kind) {
  int found = 0;
  for (const Event& event : r.simulation.events()) found += event.kind == kind ? 1 : 0;
  return found;
}

}  // namespace

class TestRigidBodyFalls : public QObject {
  Q_OBJECT

 private slots:
  void fallsAndGetsUp_data() {
    QTest::addColumn<bool>("fromBehind");
    QTest::addColumn<int>("action");
    QTest::newRow("on the front") << true << 15;
    QTest::newRow("on the back") << false << 16;
  }
  void fallsAndGetsUp() {
    QFETCH(bool, fromBehind);
    QFETCH(int, action);
    Rig r = hit(falling(), fromBehind);
    int ticks = 0;
    while (count(r, EventKind::Fall) == 0 && ticks < 60) {
      r.step();
      ++ticks;
    }
    QVERIFY(ticks < 60);
    QCOMPARE(r.robot().posture, fromBehind ? Posture::OnFront : Posture::OnBack);
    QCOMPARE(r.simulation.state().statistics[0].falls, 1U);
    QVERIFY(r.simulation.snapshot().robots[0].fallen);
    const double sign = fromBehind ? 1.0 : -1.0;
    r.commands[0].actionA = 1;  // which it cannot carry out now
    r.placeBall(1, 0);
    for (int i = 0; i < 6; ++i) {
      r.step();
      QCOMPARE(r.percepts[0].imu.state, std::optional<int>(1));
      QCOMPARE((*r.percepts[0].imu.accel)[0], sign);
      QVERIFY(std::abs((*r.percepts[0].imu.accel)[2]) < 0.01);
      QVERIFY(std::abs((*r.percepts[0].imu.eulerXY)[1] - sign * pi / 2) < 1e-12);
      QCOMPARE(r.percepts[0].ball.lost, std::optional<int>(1));
    }
    r.run(0.5);
    QCOMPARE(r.robot().posture, Posture::GettingUp);
    QCOMPARE(r.robot().action, action);
    QCOMPARE(r.percepts[0].control.action, action);
    QCOMPARE((*r.percepts[0].imu.accel)[0], sign);
    const Point place = r.robot().pose.position;
    r.run(2.0);
    QVERIFY(std::hypot(r.robot().pose.position.x - place.x, r.robot().pose.position.y - place.y) <
            1e-3);
    for (ticks = 0; count(r, EventKind::GotUp) == 0 && ticks < 120; ++ticks) r.step();
    QVERIFY(ticks > 30 && ticks < 80);  // 0.5 s lying and 3 s of getting up in all
    QCOMPARE(r.percepts[0].imu.state, std::optional<int>(0));
    r.run(1.0);
    QVERIFY(r.robot().forwardSpeed > 0.17);
  }

  void theRightActionGetsItUpAtOnce_data() {
    QTest::addColumn<bool>("fromBehind");
    QTest::addColumn<int>("action");
    QTest::addColumn<bool>("works");
    QTest::newRow("front 15") << true << 15 << true;
    QTest::newRow("front 16") << true << 16 << false;
    QTest::newRow("back 16") << false << 16 << true;
    QTest::newRow("back 15") << false << 15 << false;
  }
  void theRightActionGetsItUpAtOnce() {
    QFETCH(bool, fromBehind);
    QFETCH(int, action);
    QFETCH(bool, works);
    Rig r = hit(falling(), fromBehind);
    while (r.robot().posture == Posture::Upright) r.step();
    r.commands[0].actionA = action;
    r.step();
    QCOMPARE(r.robot().posture == Posture::GettingUp, works);
    bool finished = false;
    for (int i = 0; i < 240; ++i) {
      r.step();
      finished = finished || r.percepts[0].control.finishedAction == action;
    }
    QCOMPARE(finished, works);
    QCOMPARE(r.robot().posture, Posture::Upright);
  }

  void softHitsAndSettings_data() {
    QTest::addColumn<bool>("on");
    QTest::addColumn<double>("speed");
    QTest::addColumn<bool>("falls");
    // 0.2 kg against 4 kg with restitution 0.3: J = 1.3·v·0.2·4/4.2 = 0.2476·v N·s, and the ball
    // keeps about 0.95 of its speed on the way. 0.8 N·s needs 3.23 m/s.
    QTest::newRow("off by default") << false << 10.0 << false;
    QTest::newRow("hard") << true << 5.0 << true;
    QTest::newRow("soft") << true << 3.0 << false;
  }
  void softHitsAndSettings() {
    QFETCH(bool, on);
    QFETCH(double, speed);
    QFETCH(bool, falls);
    Rig r = hit(falling(on), true, speed);
    r.run(0.5);
    QCOMPARE(r.robot().posture != Posture::Upright, falls);
  }

  void walkingDoesNotThrowDown() {
    Rig r(falling());
    r.add({{-0.5, 0}, 0});
    r.add({{0.5, 0}, pi});
    r.add({{4.9, 2}, 0});
    r.placeBall(3, -2);
    for (RobotCommand& command : r.commands) command.actionA = 1;
    r.run(10.0);
    for (std::size_t i = 0; i < 3; ++i) QCOMPARE(r.robot(i).posture, Posture::Upright);
  }

  // Two robots that meet push each other alike: 0.68 · 2 kg · 0.36 m/s = 0.49 N·s head-on at full
  // speed, half of that if one of them stands. It does not matter where they come from, which of
  // them is the first in the list, or how the places of both are rounded.
  void whoMeetsPushesAlike_data() {
    QTest::addColumn<double>("gap");
    QTest::addColumn<double>("turned");
    for (const double gap : {0.2, 0.23, 0.5, 1.0, 1.001, 1.37}) {
      for (const double turned : {0.0, 0.5, 1.0, pi / 2}) {
        QTest::addRow("%g m, %g rad", gap, turned) << gap << turned;
      }
    }
  }
  void whoMeetsPushesAlike() {
    QFETCH(double, gap);
    QFETCH(double, turned);
    const auto meet = [&](double fallImpulse, bool bothWalk) {
      Rig r(falling());
      const double away = r.simulation.state().settings.field.robotRadius + gap / 2;
      for (const double side : {-1.0, 1.0}) {
        const double yaw = side < 0 ? turned : turned + pi;
        r.add({{side * away * std::cos(turned), side * away * std::sin(turned)}, yaw});
        RobotModel model;
        model.fallImpulse = fallImpulse;
        (void)r.simulation.setRobotModel({side < 0 ? 1 : 2}, model);
      }
      r.placeBall(3, -2);
      r.commands[0].actionA = 1;
      r.commands[1].actionA = bothWalk ? 1 : 0;
      int fallen = 0;
      for (int i = 0; i < 600 && fallen == 0; ++i) {
        r.step();
        fallen = count(r, EventKind::Fall);
      }
      return fallen;
    };
    QCOMPARE(meet(0.47, true), 2);
    QCOMPARE(meet(0.51, true), 0);
    QCOMPARE(meet(0.23, false), 2);
    QCOMPARE(meet(0.26, false), 0);
  }

  // Pressing is no push, however long it takes.
  void pressingDoesNotThrowDown_data() {
    QTest::addColumn<double>("turned");
    for (const double turned : {0.0, 0.3, 1.0, pi / 2}) {
      QTest::addRow("%g rad", turned) << turned;
    }
  }
  void pressingDoesNotThrowDown() {
    QFETCH(double, turned);
    Rig r(falling());
    const double away = r.simulation.state().settings.field.robotRadius;
    RobotModel weak;
    weak.fallImpulse = 0.15;
    for (const double side : {-1.0, 1.0}) {
      r.add({{side * away * std::cos(turned), side * away * std::sin(turned)},
             side < 0 ? turned : turned + pi});
      (void)r.simulation.setRobotModel({side < 0 ? 1 : 2}, weak);
    }
    r.placeBall(3, -2);
    for (RobotCommand& command : r.commands) command.actionA = 1;
    r.run(20.0);
    QCOMPARE(r.robot(0).posture, Posture::Upright);
    QCOMPARE(r.robot(1).posture, Posture::Upright);
  }

  // A post does not give way: 0.68 · 4 kg · 0.18 m/s = 0.49 N·s.
  void aPostThrowsDown() {
    for (const double fallImpulse : {0.47, 0.51}) {
      Rig r(falling());
      const FieldSpec& field = r.simulation.state().settings.field;
      r.add({{field.halfLength() - 1.0, field.goalWidth / 2}, 0});
      RobotModel model;
      model.fallImpulse = fallImpulse;
      (void)r.simulation.setRobotModel({1}, model);
      r.placeBall(-2, -2);
      r.commands[0].actionA = 1;
      r.run(6.0);
      QCOMPARE(r.simulation.state().statistics[0].falls > 0, fallImpulse < 0.49);
    }
  }

  void aFallenRobotDoesNotKick() {
    Rig r = hit(falling(), true);
    while (r.robot().posture == Posture::Upright) r.step();
    r.placeBall(r.robot().pose.position.x + 0.3, r.robot().pose.position.y);
    r.commands[0].actionA = 4;
    r.step(20);
    QCOMPARE(r.simulation.state().statistics[0].kicks, 0U);
  }
};

PITCHBOARD_TEST(TestRigidBodyFalls)

}  // namespace tst_rigid_body_falls

#include "tst_rigid_body_falls.moc"
