// SPDX-License-Identifier: GPL-3.0-or-later
#include <QtTest>

#include "rigid_body_rig.h"

namespace tst_imu {

using namespace rig;

class TestImu : public QObject {
  Q_OBJECT

 private slots:
  void yaw_data() {
    QTest::addColumn<double>("yawDegrees");
    QTest::addColumn<bool>("from180");
    QTest::addColumn<double>("eulerDegrees");
    QTest::newRow("0") << 0.0 << false << 0.0;
    QTest::newRow("90") << 90.0 << false << 90.0;
    QTest::newRow("-90") << -90.0 << false << -90.0;
    QTest::newRow("180") << 180.0 << false << 180.0;
    QTest::newRow("-180 is 180") << -180.0 << false << 180.0;
    QTest::newRow("facing left") << 180.0 << true << 0.0;
    QTest::newRow("facing left, up") << 90.0 << true << -90.0;
    QTest::newRow("facing left, down") << -90.0 << true << 90.0;
    QTest::newRow("from 180, facing right") << 0.0 << true << 180.0;
  }
  void yaw() {
    QFETCH(double, yawDegrees);
    QFETCH(bool, from180);
    QFETCH(double, eulerDegrees);
    Rig r;
    r.add({{-2, 0}, yawDegrees * degree}, 1, TeamColor::Red, from180);
    r.step();
    QVERIFY(std::abs(r.percepts[0].imu.eulerZ / degree - eulerDegrees) < 1e-9);
    QCOMPARE(*r.percepts[0].imu.eulerXY, (std::array<double, 2>{0, 0}));
    QCOMPARE(r.percepts[0].imu.state, std::optional<int>(0));
  }

  void resetMakesItZero() {
    Rig r;
    r.add({{-2, 0}, 2.5});
    r.commands[0].imuReset = 1;
    r.step();
    QVERIFY(r.percepts[0].imu.resetDone);
    QCOMPARE(r.percepts[0].imu.eulerZ, 0.0);
    r.commands[0].imuReset = 0;
    r.place(1, {{-2, 0}, -2.5});
    r.step();
    QVERIFY(!r.percepts[0].imu.resetDone);
    // From 2.5 to −2.5 it is 2π − 5 to the left.
    QVERIFY(std::abs(r.percepts[0].imu.eulerZ - (2 * pi - 5)) < 1e-9);
  }

  void gyroIsTheYawRate_data() {
    QTest::addColumn<int>("action");
    QTest::addColumn<double>("degreesPerSecond");
    QTest::newRow("left") << 2 << 18.0;
    QTest::newRow("right") << 3 << -18.0;
    QTest::newRow("straight") << 1 << 0.0;
  }
  void gyroIsTheYawRate() {
    QFETCH(int, action);
    QFETCH(double, degreesPerSecond);
    for (const double rate : {30.0, 60.0, 500.0}) {
      Rig r(atRate(rate));
      r.add({{-2, 0}, 3.0});
      r.commands[0].actionA = action;
      r.run(2.0);
      QVERIFY(std::abs((*r.percepts[0].imu.gyro)[2] / degree - degreesPerSecond) < 1e-6);
    }
  }

  void accelerometer() {
    Rig r;
    r.add({{-2, 0}, 1.0});
    r.step();
    QCOMPARE(*r.percepts[0].imu.accel, (std::array<double, 3>{0, 0, 1}));
    r.commands[0].actionA = 1;
    r.step();  // starting to walk: 1 m/s² forward = 0.10197 g
    QVERIFY(std::abs((*r.percepts[0].imu.accel)[0] - 0.101972) < 1e-6);
    QVERIFY(std::abs((*r.percepts[0].imu.accel)[1]) < 1e-12);
    r.run(1.0);
    QVERIFY(std::abs((*r.percepts[0].imu.accel)[0]) < 1e-12);
    r.commands[0].actionA = 6;
    r.step();  // braking forward, speeding up to the left
    QVERIFY(std::abs((*r.percepts[0].imu.accel)[0] + 0.101972) < 1e-6);
    QVERIFY(std::abs((*r.percepts[0].imu.accel)[1] - 0.101972) < 1e-6);
    r.commands[0].actionA = 14;
    r.run(2.0);  // 0.09 m/s to the right while turning left at 0.314159 rad/s: inwards is forward
    QVERIFY(std::abs((*r.percepts[0].imu.accel)[0] - 0.09 * 0.3141593 / 9.80665) < 1e-6);
  }

  void whiteNoiseHasItsSigma() {
    for (const double rate : {60.0, 500.0}) {
      SimulationSettings settings = atRate(rate);
      settings.noise.imuWhite = 0.02;
      Rig r(settings);
      r.add({{-2, 0}, 0.5});
      constexpr int draws = 20000;
      double sum = 0, squares = 0;
      for (int i = 0; i < draws; ++i) {
        r.step();
        const double error = r.percepts[0].imu.eulerZ - 0.5;
        sum += error;
        squares += error * error;
      }
      QVERIFY(std::abs(sum / draws) < 5 * 0.02 / std::sqrt(draws));
      QVERIFY(std::abs(std::sqrt(squares / draws) - 0.02) < 5 * 0.02 / std::sqrt(2.0 * draws));
    }
  }

  void driftDoesNotDependOnTheRate_data() {
    QTest::addColumn<double>("rate");
    for (const double rate : {15.0, 60.0, 240.0}) QTest::addRow("%g Hz", rate) << rate;
  }
  void driftDoesNotDependOnTheRate() {
    QFETCH(double, rate);
    SimulationSettings settings = atRate(rate);
    settings.noise.imuDrift = 0.001;
    Rig r(settings);
    constexpr int robots = 60;
    for (int i = 0; i < robots; ++i) r.add({{-4.5 + 0.6 * (i % 15), -2.0 + i / 15}, 0});
    r.placeBall(0, 2.5);
    // σ after 4 s = 0.001·√240; 60 robots in 10 stretches are 600 independent samples.
    double squares = 0;
    for (int stretch = 0; stretch < 10; ++stretch) {
      std::vector<double> before;
      for (int i = 0; i < robots; ++i)
        before.push_back(r.robot(static_cast<std::size_t>(i)).imuDrift);
      r.run(4.0);
      for (std::size_t i = 0; i < before.size(); ++i) {
        squares += std::pow(r.robot(i).imuDrift - before[i], 2);
      }
    }
    const double sigma = 0.001 * std::sqrt(240.0);
    QVERIFY(std::abs(std::sqrt(squares / 600) - sigma) < 5 * sigma / std::sqrt(1200.0));
  }
};

PITCHBOARD_TEST(TestImu)

}  // namespace tst_imu

#include "tst_imu.moc"
