// SPDX-License-Identifier: GPL-3.0-or-later
#include <QtTest>

#include "rigid_body_rig.h"

namespace tst_noise {

using namespace rig;

class TestNoise : public QObject {
  Q_OBJECT

 private slots:
  void motionNoiseDoesNotDependOnTheRate_data() {
    QTest::addColumn<double>("rate");
    for (const double rate : {10.0, 60.0, 240.0}) QTest::addRow("%g Hz", rate) << rate;
  }
  void motionNoiseDoesNotDependOnTheRate() {
    QFETCH(double, rate);
    SimulationSettings settings = atRate(rate);
    settings.noise.forward = 0.002;
    settings.noise.sideways = 0.001;
    Rig r(settings);
    r.add({{0, 0}, 0});
    r.placeBall(-4, -2.5);
    r.commands[0].actionA = 11;  // gait in place: all motion is noise
    // Over half a second: σ = per 1/60 s · √30.
    constexpr int samples = 1000;
    double forward = 0, sideways = 0, mean = 0;
    for (int i = 0; i < samples; ++i) {
      r.place(1, {{0, 0}, 0});
      r.run(0.5);
      const Point p = r.robot().pose.position;
      forward += p.x * p.x;
      sideways += p.y * p.y;
      mean += p.x;
    }
    const double sf = 0.002 * std::sqrt(30.0), ss = 0.001 * std::sqrt(30.0);
    QVERIFY(std::abs(std::sqrt(forward / samples) - sf) < 5 * sf / std::sqrt(2.0 * samples));
    QVERIFY(std::abs(std::sqrt(sideways / samples) - ss) < 5 * ss / std::sqrt(2.0 * samples));
    QVERIFY(std::abs(mean / samples) < 5 * sf / std::sqrt(samples));
  }

  void rotationNoiseDoesNotDependOnTheRate() {
    for (const double rate : {10.0, 60.0, 240.0}) {
      SimulationSettings settings = atRate(rate);
      settings.noise.rotation = 0.002;
      Rig r(settings);
      r.add({{0, 0}, 0});
      r.placeBall(-4, -2.5);
      r.commands[0].actionA = 11;
      constexpr int samples = 1000;
      double squares = 0;
      for (int i = 0; i < samples; ++i) {
        r.place(1, {{0, 0}, 0});
        r.run(0.5);
        squares += std::pow(r.robot().pose.yaw, 2);
      }
      const double sigma = 0.002 * std::sqrt(30.0);
      QVERIFY(std::abs(std::sqrt(squares / samples) - sigma) <
              5 * sigma / std::sqrt(2.0 * samples));
    }
  }

  void aStandingRobotStandsStill() {
    SimulationSettings settings;
    settings.noise.forward = settings.noise.sideways = settings.noise.rotation = 0.01;
    Rig r(settings);
    r.add({{1, 1}, 0.5});
    r.run(2.0);
    QCOMPARE(r.robot().pose, (Pose{{1, 1}, 0.5}));
  }

  void addingARobotLeavesTheOthersNoiseAlone() {
    SimulationSettings settings;
    settings.noise.forward = settings.noise.sideways = 0.002;
    settings.noise.rotation = 0.002;
    settings.noise.imuWhite = settings.noise.imuDrift = 0.01;
    settings.noise.visionDistance = settings.noise.visionBearing = 0.05;
    settings.noise.missedDetection = 0.3;
    Rig alone(settings);
    Rig crowd(settings);
    alone.add({{-2, 0}, 0}, 5);
    crowd.add({{3, 2}, 1}, 2);  // before it in order, too
    crowd.add({{-2, 0}, 0}, 5);
    crowd.add({{3, -2}, 1}, 9);
    for (RobotCommand& command : crowd.commands) command.actionA = 1;
    alone.commands[0].actionA = 1;
    for (int i = 0; i < 300; ++i) {
      alone.step();
      crowd.step();
      QCOMPARE(crowd.robot(1).pose, alone.robot(0).pose);
      QCOMPARE(crowd.percepts[1].imu.eulerZ, alone.percepts[0].imu.eulerZ);
      QCOMPARE(crowd.percepts[1].ball.distanceCm, alone.percepts[0].ball.distanceCm);
      QCOMPARE(crowd.percepts[1].ball.lost, alone.percepts[0].ball.lost);
    }
  }

  void anotherSeedIsAnotherRun() {
    SimulationSettings settings;
    settings.noise.forward = 0.002;
    Rig one(settings);
    settings.seed = 2;
    Rig two(settings);
    for (Rig* r : {&one, &two}) {
      r->add({{-2, 0}, 0});
      r->commands[0].actionA = 1;
      r->run(1.0);
    }
    QVERIFY(one.robot().pose.position.x != two.robot().pose.position.x);
  }

  void kickNoiseHasItsSigma() {
    SimulationSettings settings;
    settings.noise.kickSpeed = 0.2;
    settings.noise.kickAngle = 0.1;
    Rig r(settings);
    r.add({{-1, 0}, 0});
    r.commands[0].actionA = 4;
    constexpr int kicks = 4000;
    double speed = 0, speeds = 0, angles = 0;
    for (int i = 0; i < kicks; ++i) {
      r.placeBall(-0.75, 0);
      r.step();
      const Velocity v = r.ball().velocity;
      const double s = std::hypot(v.x, v.y) / 0.95;
      speed += s;
      speeds += std::pow(s - 2.648732, 2);
      angles += std::pow(std::atan2(v.y, v.x), 2);
    }
    const double five = 5 / std::sqrt(2.0 * kicks);
    QVERIFY(std::abs(speed / kicks - 2.648732) < 5 * 0.2 / std::sqrt(kicks));
    QVERIFY(std::abs(std::sqrt(speeds / kicks) - 0.2) < 0.2 * five);
    QVERIFY(std::abs(std::sqrt(angles / kicks) - 0.1) < 0.1 * five);
  }
};

PITCHBOARD_TEST(TestNoise)

}  // namespace tst_noise

#include "tst_noise.moc"
