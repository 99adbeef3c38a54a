// SPDX-License-Identifier: GPL-3.0-or-later
#include <QtTest>

#include "rigid_body_rig.h"

namespace tst_rigid_body_vision {

using namespace rig;

class TestRigidBodyVision : public QObject {
  Q_OBJECT

 private slots:
  void fieldOfView_data() {
    QTest::addColumn<double>("distance");
    QTest::addColumn<double>("bearing");
    QTest::addColumn<double>("head");
    QTest::addColumn<bool>("seen");
    QTest::newRow("ahead") << 1.0 << 0.0 << 0.0 << true;
    QTest::newRow("34° left") << 1.0 << 34.0 << 0.0 << true;
    QTest::newRow("36° left") << 1.0 << 36.0 << 0.0 << false;
    QTest::newRow("34° right") << 1.0 << -34.0 << 0.0 << true;
    QTest::newRow("36° right") << 1.0 << -36.0 << 0.0 << false;
    QTest::newRow("head left") << 1.0 << 120.0 << 100.0 << true;
    QTest::newRow("across the back") << 1.0 << -165.0 << 134.0 << false;
    QTest::newRow("2.99 m") << 2.99 << 10.0 << 0.0 << true;
    QTest::newRow("3.01 m") << 3.01 << 10.0 << 0.0 << false;
  }
  void fieldOfView() {
    QFETCH(double, distance);
    QFETCH(double, bearing);
    QFETCH(double, head);
    QFETCH(bool, seen);
    for (const double yaw : {0.0, 3.0, -2.0}) {
      Rig r;
      r.add({{0.2, 0.1}, yaw});
      (void)r.simulation.placeHead({1}, yaw + head * degree);
      const double at = yaw + bearing * degree;
      r.placeBall(0.2 + distance * std::cos(at), 0.1 + distance * std::sin(at));
      r.step();
      const BallPercept& ball = r.percepts[0].ball;
      QCOMPARE(ball.lost, std::optional<int>(seen ? 0 : 1));
      QCOMPARE(ball.distanceCm.has_value(), seen);
      if (!seen) continue;
      QVERIFY(std::abs(*ball.distanceCm - 100 * distance) < 1e-9);
      QVERIFY(std::abs(*ball.angleDeg - bearing) < 1e-9);
      QVERIFY(std::abs(*ball.panDeg - bearing) < 1e-9);
    }
  }

  void searchSweepsBetweenTheLimits_data() {
    QTest::addColumn<double>("rate");
    for (const double rate : {10.0, 60.0, 500.0}) QTest::addRow("%g Hz", rate) << rate;
  }
  void searchSweepsBetweenTheLimits() {
    QFETCH(double, rate);
    Rig r(atRate(rate));
    r.add({{-4, -2}, 0});
    r.placeBall(4, 2);
    r.commands[0].searchOn = 1;
    double least = 0, most = 0;
    // A whole sweep is 4·135° at 60°/s = 9 s.
    for (int i = 0; i < static_cast<int>(10 * rate); ++i) {
      const double before = r.robot().headYaw;
      r.step();
      QVERIFY(std::abs(r.robot().headYaw - before) <= 60 * degree / rate + 1e-9);
      least = std::min(least, r.robot().headYaw);
      most = std::max(most, r.robot().headYaw);
      QVERIFY(!r.percepts[0].searchOn.has_value());
    }
    QVERIFY(std::abs(least + 135 * degree) < 1e-9);
    QVERIFY(std::abs(most - 135 * degree) < 1e-9);
  }

  void searchEndsAtTheBall() {
    Rig r;
    r.add({{0, 0}, 0});
    r.placeBall(0, 1);  // 90° to the left; the search starts to the right
    r.commands[0].searchOn = 1;
    bool cleared = false;
    for (int i = 0; i < 600 && !cleared; ++i) {
      r.step();
      cleared = r.percepts[0].searchOn == 0;
      if (cleared) QVERIFY(std::abs(r.robot().headYaw - pi / 2) <= degree + 1e-9);
    }
    QVERIFY(cleared);
    r.commands[0].searchOn = 0;
    r.placeBall(-0.5, 1);
    r.run(2.0);  // the head follows without a search
    QVERIFY(std::abs(r.robot().headYaw - std::atan2(1, -0.5)) < 1e-9);
    r.placeBall(-0.8, 0.55);  // in view, but beyond the neck
    r.run(2.0);
    QVERIFY(std::abs(r.robot().headYaw - 135 * degree) < 1e-9);
    QVERIFY(!r.percepts[0].searchOn.has_value());
  }

  void delay_data() {
    QTest::addColumn<double>("rate");
    QTest::addColumn<double>("delay");
    QTest::addColumn<int>("ticks");
    QTest::newRow("none") << 60.0 << 0.0 << 0;
    QTest::newRow("100 ms at 60 Hz") << 60.0 << 0.1 << 6;
    QTest::newRow("100 ms at 500 Hz") << 500.0 << 0.1 << 50;
    QTest::newRow("100 ms at 10 Hz") << 10.0 << 0.1 << 1;
  }
  void delay() {
    QFETCH(double, rate);
    QFETCH(double, delay);
    QFETCH(int, ticks);
    SimulationSettings settings = atRate(rate);
    settings.noise.visionDelay = delay;
    Rig r(settings);
    r.add({{0, 0}, 0});
    r.placeBall(1, 0);
    r.step(ticks + 5);
    QCOMPARE(r.percepts[0].ball.lost, std::optional<int>(0));
    r.placeBall(-3, 0);
    for (int i = 0; i < ticks; ++i) {
      r.step();
      QCOMPARE(r.percepts[0].ball.lost, std::optional<int>(0));
      QVERIFY(std::abs(*r.percepts[0].ball.distanceCm - 100) < 1e-9);
    }
    r.step();
    QCOMPARE(r.percepts[0].ball.lost, std::optional<int>(1));
  }

  void everythingThatIsSeenComesLate() {
    constexpr int delay = 6;  // ticks of 0.1 s
    SimulationSettings late;
    late.noise.visionDelay = 0.1;
    Rig now, then(late);
    for (Rig* r : {&now, &then}) {
      r->add({{0, 0}, 0});
      r->add({{1.0, 0.3}, 2.0}, 2, TeamColor::Red);
      r->placeBall(1.5, -0.2, 0.4, 0.1);
      r->commands[0].actionA = 2;  // turns, so that everything moves in its view
      r->commands[1].actionA = 1;
      r->commands[0].actionVision = 2;
    }
    std::vector<Percepts> seen;
    for (int tick = 0; tick < 120; ++tick) {
      // Corners and the ball as a landmark by turns, asked for alike in the moment of the image
      // and in that of the answer.
      now.commands[0].localizationLook = tick / delay % 2;
      then.commands[0].localizationLook = (tick / delay + 1) % 2;
      now.step();
      then.step();
      seen.push_back(now.percepts[0]);
      const Percepts& reported = then.percepts[0];
      if (tick < delay) {
        QVERIFY(!reported.robots[1]);
        QVERIFY(!reported.landmarks.bearingsDeg || (*reported.landmarks.bearingsDeg)[1] == -999.0);
        continue;
      }
      const Percepts& was = seen[static_cast<std::size_t>(tick - delay)];
      QCOMPARE(reported.robots[1].has_value(), was.robots[1].has_value());
      if (was.robots[1]) {
        QCOMPARE(reported.robots[1]->distanceCm, was.robots[1]->distanceCm);
        QCOMPARE(reported.robots[1]->angleDeg, was.robots[1]->angleDeg);
      }
      QCOMPARE(reported.landmarks.bearingsDeg, was.landmarks.bearingsDeg);
      QCOMPARE(reported.landmarks.ballTiltDeg, was.landmarks.ballTiltDeg);
      QCOMPARE(reported.landmarks.ballPanDeg, was.landmarks.ballPanDeg);
    }
  }

  void delayCanChangeWhileRunning() {
    Rig r;
    r.add({{0, 0}, 0});
    r.placeBall(1, 0);
    NoiseParameters noise;
    for (const double seconds : {0.2, 0.05, 0.0, 0.1}) {
      noise.visionDelay = seconds;
      QVERIFY(r.simulation.setNoise(noise).has_value());
      r.run(0.5);
      QCOMPARE(r.percepts[0].ball.lost, std::optional<int>(0));
    }
  }

  void noiseAndMissedDetections() {
    SimulationSettings settings;
    settings.noise.visionDistance = 0.1;
    settings.noise.visionBearing = 0.05;
    settings.noise.missedDetection = 0.2;
    Rig r(settings);
    r.add({{0, 0}, 0});
    r.placeBall(2 * std::cos(0.2), 2 * std::sin(0.2));
    constexpr int draws = 20000;
    int seen = 0;
    double d = 0, dd = 0, b = 0, bb = 0;
    for (int i = 0; i < draws; ++i) {
      r.step();
      const BallPercept& ball = r.percepts[0].ball;
      QCOMPARE(*ball.lost == 0, ball.distanceCm.has_value());
      if (!ball.distanceCm) continue;
      ++seen;
      const double distance = *ball.distanceCm / 100 - 2;
      const double bearing = *ball.angleDeg * degree - 0.2;
      d += distance;
      dd += distance * distance;
      b += bearing;
      bb += bearing * bearing;
    }
    const double root = std::sqrt(seen), five = 5 / std::sqrt(2.0 * seen);
    QVERIFY(std::abs(seen - 0.8 * draws) < 5 * std::sqrt(draws * 0.2 * 0.8));
    QVERIFY(std::abs(d / seen) < 5 * 0.2 / root);
    QVERIFY(std::abs(std::sqrt(dd / seen) - 0.2) < 0.2 * five);
    QVERIFY(std::abs(b / seen) < 5 * 0.05 / root);
    QVERIFY(std::abs(std::sqrt(bb / seen) - 0.05) < 0.05 * five);
  }

  void otherRobots_data() {
    QTest::addColumn<int>("look");
    QTest::newRow("team-mates") << 1;
    QTest::newRow("opponents") << 2;
  }
  void otherRobots() {
    QFETCH(int, look);
    Rig r;
    r.add({{0, 0}, 0}, 1, TeamColor::Blue);
    r.add({{1, 0.2}, 0}, 2, TeamColor::Blue);  // mate, 11.3° left
    r.add({{1, -0.3}, 0}, 3, TeamColor::Red);  // opponent, 16.7° right
    r.add({{-1, 0}, 0}, 4, TeamColor::Red);    // behind
    r.placeBall(2, 0);
    r.commands[0].actionVision = look;
    r.commands[0].searchOn = 0;
    r.step();
    const auto& seen = r.percepts[0].robots;
    QCOMPARE(seen[1].has_value(), look == 1);
    QCOMPARE(seen[2].has_value(), look == 2);
    QVERIFY(!seen[0] && !seen[3]);
    if (look == 1) {
      QVERIFY(std::abs(seen[1]->distanceCm - 101.980390) < 1e-5);
      QVERIFY(std::abs(seen[1]->angleDeg + 11.309932) < 1e-5);
    } else {
      QVERIFY(std::abs(seen[2]->distanceCm - 104.403065) < 1e-5);
      QVERIFY(std::abs(seen[2]->angleDeg - 16.699244) < 1e-5);
    }
    // Looking for robots says nothing about the ball.
    QVERIFY(!r.percepts[0].ball.lost && !r.percepts[0].ball.distanceCm);
    QVERIFY(!r.percepts[0].searchOn);
  }

  void cornersOfTheField() {
    Rig r;
    r.add({{0, 0}, 0});
    r.commands[0].localizationLook = 1;
    r.step();
    const auto& bearings = *r.percepts[0].landmarks.bearingsDeg;
    // Facing right from the centre: atan(3 / 4.5) = 33.690°, red above and purple below.
    QCOMPARE(bearings[0], -999.0);
    QVERIFY(std::abs(bearings[1] - 33.690068) < 1e-5);
    QCOMPARE(bearings[2], -999.0);
    QVERIFY(std::abs(bearings[3] + 33.690068) < 1e-5);
    QVERIFY(!r.percepts[0].landmarks.ballTiltDeg);
  }

  void landmarksHaveTheirNoise() {
    SimulationSettings settings;
    settings.noise.landmarkProbability = 0.25;
    settings.noise.landmarkBearing = 0.0873;
    Rig r(settings);
    r.add({{0, 0}, 0});
    r.commands[0].localizationLook = 1;
    constexpr int draws = 20000;
    int seen = 0;
    double squares = 0;
    for (int i = 0; i < draws; ++i) {
      r.step();
      const double bearing = (*r.percepts[0].landmarks.bearingsDeg)[1];
      if (bearing == -999.0) continue;
      ++seen;
      squares += std::pow(bearing * degree - std::atan2(3.0, 4.5), 2);
    }
    QVERIFY(std::abs(seen - 0.25 * draws) < 5 * std::sqrt(draws * 0.25 * 0.75));
    QVERIFY(std::abs(std::sqrt(squares / seen) - 0.0873) < 5 * 0.0873 / std::sqrt(2.0 * seen));
  }

  void ballAsLandmark() {
    Rig r;
    r.add({{0, 0}, 0});
    r.placeBall(0.5, 4.0 - 1.2);  // beyond range and view of the camera, in front of the body
    r.step();
    QVERIFY(std::abs(*r.percepts[0].landmarks.ballTiltDeg - 284.429253) < 1e-5);
    QVERIFY(std::abs(*r.percepts[0].landmarks.ballPanDeg - 79.875328) < 1e-5);
    r.placeBall(-0.5, 1);
    r.step();
    QCOMPARE(*r.percepts[0].landmarks.ballTiltDeg, -1.0);
    r.commands[0].localizationLook = 7;
    r.step();
    QVERIFY(!r.percepts[0].landmarks.ballTiltDeg && !r.percepts[0].landmarks.bearingsDeg);
  }

  void onlyItsOwnFlags() {
    Rig r;
    r.add({{0, 0}, 0});
    r.step();
    QVERIFY(!r.percepts[0].decisionWorking);
  }
};

PITCHBOARD_TEST(TestRigidBodyVision)

}  // namespace tst_rigid_body_vision

#include "tst_rigid_body_vision.moc"
