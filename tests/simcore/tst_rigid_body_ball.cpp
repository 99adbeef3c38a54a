// SPDX-License-Identifier: GPL-3.0-or-later
#include <QtTest>

#include <simcore/world/field.h>
#include <simcore/world/parameters.h>

#include "rigid_body_rig.h"

namespace tst_rigid_body_ball {

using namespace rig;

class TestRigidBodyBall : public QObject {
  Q_OBJECT

 private slots:
  void rollsAsFarAtEveryRate_data() {
    QTest::addColumn<double>("rate");
    for (const double rate : {10.0, 30.0, 60.0, 120.0, 1000.0}) {
      QTest::addRow("%g Hz", rate) << rate;
    }
  }
  void rollsAsFarAtEveryRate() {
    QFETCH(double, rate);
    Rig r(atRate(rate));
    r.placeBall(-2, 0, 6, 0);
    // The published discrete sum after 60 frames: 0.1 m · Σ 0.95^k = 0.1·0.95·(1 − 0.95^60)/0.05.
    r.run(1.0);
    const double way = 1.9 * (1.0 - std::pow(0.95, 60));
    QVERIFY(std::abs(r.ball().position.x + 2 - way) < 1e-9);
    QVERIFY(std::abs(r.ball().velocity.x - 6 * std::pow(0.95, 60)) < 1e-9);
    r.run(20.0);
    QVERIFY(std::abs(r.ball().position.x + 2 - 1.9) < 1e-9);
  }

  void equalsThePublishedBallTickByTick() {
    Rig r;
    r.placeBall(-2, 0, 3, 1);
    double x = -2, y = 0, vx = 3, vy = 1;
    for (int i = 0; i < 200; ++i) {
      r.step();
      vx *= 0.95;
      vy *= 0.95;
      x += vx / 60;
      y += vy / 60;
      QVERIFY(std::abs(r.ball().position.x - x) < 1e-10);
      QVERIFY(std::abs(r.ball().position.y - y) < 1e-10);
    }
  }

  void realFieldsHaveGrass() {
    for (const FieldSpec& field : builtInFields()) {
      const bool published = field.name == "published";
      QVERIFY2(field.surface == (published ? Surface{0.0, 0.95} : Surface{0.30, 1.0}),
               field.name.c_str());
    }
  }

  void rollsTheDistanceOfTheSurface_data() {
    QTest::addColumn<double>("deceleration");
    QTest::addColumn<double>("kept");
    QTest::newRow("published") << 0.0 << 0.95;
    QTest::newRow("grass") << 0.3 << 1.0;
    QTest::newRow("both") << 0.3 << 0.98;
    QTest::newRow("sticks") << 0.0 << 0.0;
  }
  void rollsTheDistanceOfTheSurface() {
    QFETCH(double, deceleration);
    QFETCH(double, kept);
    SimulationSettings settings = atRate(1000);
    settings.field.surface = {deceleration, kept};
    Rig r(settings);
    r.placeBall(-4, 0, 1.8, 0);
    r.run(12.0);
    const double reported = rollingDistance(settings.field.surface, 1.8);
    QVERIFY2(std::abs(r.ball().position.x + 4 - reported) < 0.01,
             qPrintable(QString("%1 for %2").arg(r.ball().position.x + 4).arg(reported)));
    QCOMPARE(rollingDistance(settings.field.surface, 0.0), 0.0);
  }

  // The surface is the field's alone: noise changes what robots see and do, not how a ball rolls.
  void noiseDoesNotChangeTheRoll() {
    const auto rollsTo = [](const NoiseParameters& noise) {
      SimulationSettings settings;
      settings.field = fieldByName("kid-2020").value();
      settings.noise = noise;
      Rig r(settings);
      r.add({{-4, -2}, 0});
      r.placeBall(-2, 0, 1.5, 0.2);
      r.run(8.0);
      return r.ball().position;
    };
    NoiseParameters all;
    for (const auto& parameter : noiseParameters) all.*parameter.member = 0.1;
    QVERIFY(!(all == NoiseParameters{}));
    QVERIFY(rollsTo(all) == rollsTo({}));
    QVERIFY(rollsTo({}).x > 1.0);
  }

  void frictionLimits_data() {
    QTest::addColumn<double>("friction");
    QTest::addColumn<double>("way");
    QTest::newRow("none") << 1.0 << 1.0;
    QTest::newRow("sticks") << 0.0 << 0.0;
  }
  void frictionLimits() {
    QFETCH(double, friction);
    QFETCH(double, way);
    SimulationSettings settings;
    settings.field.surface.keptPerFrame = friction;
    Rig r(settings);
    r.placeBall(0, 0, 1, 0);
    r.run(1.0);
    QVERIFY(std::abs(r.ball().position.x - way) < 1e-9);
  }

  void bounces_data() {
    QTest::addColumn<double>("rate");
    QTest::addColumn<QString>("off");
    for (const double rate : {10.0, 30.0, 60.0, 240.0, 1000.0}) {
      for (const char* off : {"post", "wall", "side net", "back", "robot"}) {
        QTest::addRow("%s at %g Hz", off, rate) << rate << QString(off);
      }
    }
  }
  void bounces() {
    QFETCH(double, rate);
    QFETCH(QString, off);
    SimulationSettings settings = atRate(rate);
    settings.field.surface.keptPerFrame = 1.0;  // so that speeds before and after compare
    settings.afterGoal = AfterGoal::StopClock;
    Rig r(settings);
    r.simulation.setClockRunning(false);
    // Each starts at 1 m from contact, straight at it with 4 m/s.
    double wanted = 0.6 * 4;
    bool alongX = true;
    if (off == "post") {
      r.placeBall(4.5 - 0.19 - 1.0, 0.9, 4, 0);
    } else if (off == "wall") {
      // In a field whose border is narrower than the ball it never is wholly out.
      settings.field.border = settings.field.goalDepth = 0.15;
      Rig w(settings);
      w.placeBall(0, 3.15 - 0.09 - 1.0, 0, 4);
      w.run(0.5);
      QVERIFY(std::abs(w.ball().velocity.y + wanted) < 0.02);
      QVERIFY(deepestOverlap(w) < 0.001);
      return;
    } else if (off == "side net") {
      alongX = false;
      r.placeBall(4.8, 0.9 - 0.09 - 1.0, 0, 4);
    } else if (off == "back") {
      r.placeBall(5.2 - 0.09 - 1.0, 0, 4, 0);
    } else {
      r.add({{2, 0}, 1.0});
      RobotModel heavy;
      heavy.mass = 200;
      QVERIFY(r.simulation.setRobotModel({1}, heavy));
      r.placeBall(2 - 0.22 - 1.0, 0, 4, 0);
      wanted = 0.3 * 4 - 4 * 1.3 * 0.2 / 200.2;  // against 200 kg: nearly the restitution
    }
    r.run(0.5);
    const double speed = alongX ? r.ball().velocity.x : r.ball().velocity.y;
    QVERIFY2(std::abs(speed + wanted) < 0.02, qPrintable(QString::number(speed)));
    QVERIFY(deepestOverlap(r) < 0.001);
  }

  void neverTunnels_data() {
    QTest::addColumn<double>("rate");
    for (const double rate : {10.0, 20.0, 60.0, 120.0, 1000.0}) {
      QTest::addRow("%g Hz", rate) << rate;
    }
  }
  void neverTunnels() {
    QFETCH(double, rate);
    SimulationSettings settings = atRate(rate);
    settings.afterGoal = AfterGoal::StopClock;
    for (int k = 0; k < 100; ++k) {
      // Into the goal from all over its mouth and at many speeds: it stays behind the line.
      Rig r(settings);
      const double y = -0.55 + 0.011 * k;
      // Up to the strongest kick it cannot come out again within a tick.
      const bool kicked = k % 2 == 0;
      r.placeBall(4.0, y, kicked ? 3.0 + 0.03 * k : 5.0 + 0.4 * k, 0.1 * (k % 7 - 3));
      bool crossed = false;
      for (int i = 0; i < static_cast<int>(rate); ++i) {
        r.step();
        const Point p = r.ball().position;
        QVERIFY(std::abs(p.x) <= 5.2 - 0.09 + 0.001);
        crossed = crossed || p.x > 4.6;
        QVERIFY(deepestOverlap(r) < 0.001);
      }
      QVERIFY(crossed || !kicked);
    }
    for (int k = 0; k < 40; ++k) {
      // At a robot that stands in the way.
      Rig r(settings);
      r.add({{1, 0}, 0});
      r.placeBall(-1, -0.1 + 0.005 * k, 2.0 * k + 8, 0);
      for (int i = 0; i < static_cast<int>(rate); ++i) {
        r.step();
        QVERIFY(deepestOverlap(r) < 0.001);
        const Point p = r.ball().position;
        QVERIFY(p.x < 1.0 || std::abs(p.y) > 0.1);
      }
    }
  }

  void goals_data() {
    QTest::addColumn<double>("x");
    QTest::addColumn<bool>("clock");
    QTest::addColumn<int>("after");
    for (const double x : {-4.3, 4.3}) {
      for (const bool clock : {true, false}) {
        for (const int after : {0, 1}) {
          QTest::addRow("x %g, clock %d, after %d", x, clock, after) << x << clock << after;
        }
      }
    }
  }
  void goals() {
    QFETCH(double, x);
    QFETCH(bool, clock);
    QFETCH(int, after);
    SimulationSettings settings;
    settings.afterGoal = static_cast<AfterGoal>(after);
    Rig r(settings);
    r.simulation.setClockRunning(clock);
    r.placeBall(x, 0, std::copysign(2.0, x), 0);
    int events = 0;
    bool counted = false;
    for (int i = 0; i < 120; ++i) {
      r.step();
      for (const Event& event : r.simulation.events()) {
        ++events;
        QCOMPARE(event.kind, EventKind::Goal);
        QCOMPARE(event.value, x > 0 ? 0 : 1);
        counted = true;
      }
      if (!counted && clock) QVERIFY(std::abs(r.ball().position.x) <= 4.59);
    }
    const Score score = r.simulation.state().score;
    QCOMPARE(events, clock ? 1 : 0);
    QCOMPARE(score.left, clock && x > 0 ? 1 : 0);
    QCOMPARE(score.right, clock && x < 0 ? 1 : 0);
    if (clock && settings.afterGoal == AfterGoal::CentreBall) {
      QCOMPARE(r.ball().position, (Point{0, 0}));
      QVERIFY(r.simulation.state().clockRunning);
    } else {
      QVERIFY(std::abs(r.ball().position.x) > 4.59);
      QVERIFY(!r.simulation.state().clockRunning);
    }
  }

  void out_data() {
    QTest::addColumn<Point>("from");
    QTest::addColumn<Velocity>("velocity");
    QTest::addColumn<Point>("back");
    QTest::newRow("upper line") << Point{1, 2.9} << Velocity{0, 3} << Point{1, 2};
    QTest::newRow("lower line") << Point{-4, -2.9} << Velocity{0, -3} << Point{-3.5, -2};
    QTest::newRow("right line") << Point{4.4, 1.5} << Velocity{3, 0} << Point{3.5, 1.5};
    QTest::newRow("left line, far") << Point{-4.4, -2.5} << Velocity{-3, 0} << Point{-3.5, -2};
  }
  void out() {
    QFETCH(Point, from);
    QFETCH(Velocity, velocity);
    QFETCH(Point, back);
    Rig r;
    r.placeBall(from.x, from.y, velocity.x, velocity.y);
    int events = 0;
    for (int i = 0; i < 60; ++i) {
      r.step();
      for (const Event& event : r.simulation.events()) {
        QCOMPARE(event.kind, EventKind::BallOut);
        ++events;
      }
    }
    QCOMPARE(events, 1);
    QVERIFY(std::hypot(r.ball().position.x - back.x, r.ball().position.y - back.y) < 1e-9);
    QCOMPARE(r.ball().velocity, Velocity{});
  }

  void aWalkingRobotPushesItGently() {
    Rig r;
    r.add({{0, 0}, 0});
    r.placeBall(0.4, 0.0);
    r.commands[0].actionA = 1;
    double fastest = 0;
    for (int i = 0; i < 600; ++i) {
      r.step();
      fastest = std::max(fastest, r.ball().velocity.x);
      QVERIFY(deepestOverlap(r) < 0.001);
    }
    QVERIFY(r.ball().position.x > 1.0);
    QVERIFY2(fastest < 0.5, qPrintable(QString::number(fastest)));
    QVERIFY(r.robot().pose.position.x > 1.5);
  }
};

PITCHBOARD_TEST(TestRigidBodyBall)

}  // namespace tst_rigid_body_ball

#include "tst_rigid_body_ball.moc"
