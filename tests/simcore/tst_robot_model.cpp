// SPDX-License-Identifier: GPL-3.0-or-later
// What a robot's model changes in the simulation: gait, kick, body, camera.
#include <QtTest>

#include "rigid_body_rig.h"

namespace tst_robot_model {

using namespace rig;

namespace {

RobotModel footed() {
  RobotModel model;
  model.name = "footed";
  model.kickLaw = KickLaw::Foot;
  model.kickSpeed = 2.0;
  model.weakKickSpeed = 1.0;
  model.passSpeed = 1.5;
  model.kickReach = 0.45;
  model.kickOuter = 45 * degree;
  model.kickInner = 10 * degree;
  model.footSide = 0.06;
  model.footWidth = 0.2;
  return model;
}

Rig with(const RobotModel& model, const SimulationSettings& settings = {}) {
  Rig r(settings);
  r.add({{0, 0}, 0});
  if (const auto set = r.simulation.setRobotModel({1}, model); !set) {
    qFatal("%s", set.error().text().c_str());
  }
  return r;
}

/// Speed of a ball that lay still and was kicked at once.
double kicked(const RobotModel& model, int action, double x, double y) {
  SimulationSettings settings;
  settings.field.surface.keptPerFrame = 1.0;
  Rig r = with(model, settings);
  r.placeBall(x, y);
  r.commands[0].actionA = action;
  r.step();
  return std::hypot(r.ball().velocity.x, r.ball().velocity.y);
}

}  // namespace

class TestRobotModel : public QObject {
  Q_OBJECT

 private slots:
  void everyActionHasItsSpeed_data() {
    QTest::addColumn<int>("action");
    QTest::addColumn<double>("forward");
    QTest::addColumn<double>("left");
    QTest::addColumn<double>("turn");
    QTest::newRow("forward") << 1 << 0.5 << 0.0 << 0.0;
    QTest::newRow("forward, slow") << 8 << 0.3 << 0.0 << 0.0;
    QTest::newRow("backward") << 17 << -0.4 << 0.0 << 0.0;
    QTest::newRow("backward, slow") << 18 << -0.2 << 0.0 << 0.0;
    QTest::newRow("left") << 6 << 0.0 << 0.25 << 0.0;
    QTest::newRow("right") << 7 << 0.0 << -0.25 << 0.0;
    QTest::newRow("turn left") << 2 << 0.0 << 0.0 << 1.5;
    QTest::newRow("turn right") << 3 << 0.0 << 0.0 << -1.5;
    QTest::newRow("around left") << 9 << 0.0 << 0.15 << -0.7;
    QTest::newRow("around right") << 14 << 0.0 << -0.15 << 0.7;
    QTest::newRow("in place") << 11 << 0.0 << 0.0 << 0.0;
  }
  void everyActionHasItsSpeed() {
    QFETCH(int, action);
    QFETCH(double, forward);
    QFETCH(double, left);
    QFETCH(double, turn);
    RobotModel model;
    model.forwardFast = 0.5;
    model.forwardSlow = 0.3;
    model.backwardFast = 0.4;
    model.backwardSlow = 0.2;
    model.sideways = 0.25;
    model.turn = 1.5;
    model.aroundSideways = 0.15;
    model.aroundTurn = 0.7;
    Rig r = with(model);
    r.placeBall(3, 2);
    r.commands[0].actionA = action;
    r.commands[0].actionB = 10;
    r.run(2.0);
    QVERIFY(std::abs(r.robot().forwardSpeed - forward) < 1e-12);
    QVERIFY(std::abs(r.robot().sidewaysSpeed - left) < 1e-12);
    QVERIFY(std::abs(r.robot().yawRate - turn) < 1e-12);
  }

  void slowWalkingTakesTenthsOfItsSpeed() {
    RobotModel model;
    model.forwardSlow = 0.4;
    QCOMPARE(gaitSpeed(model, 8, 5).forward, 0.2);
    QCOMPARE(gaitSpeed(model, 8, 10).forward, 0.4);
    QCOMPARE(gaitSpeed(model, 8, 99).forward, 0.4);
    QVERIFY(!gaitSpeed(model, 42, 0).inMotion);
  }

  void aFootHitsWithinItsReachAndSector() {
    const RobotModel model = footed();
    // Squarely before the right foot: all of the speed, for the right foot only.
    QVERIFY(std::abs(kicked(model, 4, 0.3, -0.06) - 2.0) < 1e-9);
    QVERIFY(std::abs(kicked(model, 21, 0.3, -0.06) - 1.0) < 1e-9);
    QCOMPARE(kicked(model, 5, 0.3, -0.06), 0.0);  // 11 degrees to the other side of the left foot
    // 0.2 m beside it: exp(-1/2) of the speed.
    QVERIFY(std::abs(kicked(model, 4, 0.3, -0.26) - 2.0 * std::exp(-0.5)) < 1e-9);
    QCOMPARE(kicked(model, 4, 0.46, 0.0), 0.0);
    QVERIFY(kicked(model, 4, 0.44, 0.0) > 1.9);
    QCOMPARE(kicked(model, 4, 0.2, -0.21), 0.0);  // 46 degrees
    QCOMPARE(kicked(model, 4, -0.3, 0.0), 0.0);
    QVERIFY(std::abs(kicked(model, 12, 0.3, 0.06) - 1.5) < 1e-9);
    QVERIFY(std::abs(kicked(model, 13, 0.3, 0.06) - 1.5) < 1e-9);
  }

  void aKickTakesItsTime() {
    RobotModel model = footed();
    model.kickTime = 1.0;
    model.kickContact = 0.5;
    Rig r = with(model);
    r.placeBall(0.3, -0.06);
    r.commands[0].actionA = 4;
    r.step();
    QVERIFY(!r.percepts[0].control.finishedAction);
    r.commands[0].actionA = 1;  // no command is read meanwhile
    r.step(29);
    QCOMPARE(r.ball().velocity.x, 0.0);
    QCOMPARE(r.percepts[0].control.moving.value_or(0), 1);
    r.step(3);
    QVERIFY(r.ball().velocity.x > 1.0);
    QCOMPARE(r.robot().pose.position.x, 0.0);
    r.step(28);
    QCOMPARE(r.percepts[0].control.finishedAction.value_or(0), 4);
    r.step(30);
    QVERIFY(r.robot().pose.position.x > 0.02);
    QCOMPARE(r.simulation.state().statistics[0].kicks, 1U);
  }

  void bodiesHaveTheirOwnSizes() {
    Rig r;
    r.add({{0, 0}, 0});
    r.add({{1, 0}, pi});
    RobotModel big;
    big.radius = 0.3;
    QVERIFY(r.simulation.setRobotModel({2}, big));
    r.commands[0].actionA = r.commands[1].actionA = 1;
    r.placeBall(0, 2);
    r.run(10.0);
    const double gap = r.robot(1).pose.position.x - r.robot(0).pose.position.x;
    QVERIFY2(std::abs(gap - 0.43) < 0.002, qPrintable(QString::number(gap)));
    QCOMPARE(r.simulation.snapshot().robots[0].radius, 0.0);  // the field's
    QCOMPARE(r.simulation.snapshot().robots[1].radius, 0.3);
  }

  void distancesAreMeasuredFromTheCameraOrTheBody() {
    RobotModel model;
    model.cameraForward = 0.1;
    model.cameraHeight = 0.5;
    Rig body = with(model);
    body.placeBall(1, 0);
    body.step();
    QVERIFY(std::abs(body.percepts[0].ball.distanceCm.value_or(0) - 100.0) < 1e-9);
    model.fromCamera = true;
    Rig camera = with(model);
    camera.placeBall(1, 0);
    camera.step();
    const double wanted = 100.0 * std::hypot(0.9, 0.5 - 0.09);
    QVERIFY(std::abs(camera.percepts[0].ball.distanceCm.value_or(0) - wanted) < 1e-9);
  }

  void everyRobotSeesWithItsOwnCamera() {
    Rig r;
    r.add({{0, 0}, 0});
    r.add({{0, 1}, 0});
    RobotModel far;
    far.visionRange = 5.0;
    QVERIFY(r.simulation.setRobotModel({2}, far));
    r.placeBall(4, 0.5);
    r.step();
    QCOMPARE(r.percepts[0].ball.lost.value_or(-1), 1);
    QCOMPARE(r.percepts[1].ball.lost.value_or(-1), 0);
  }

  void theNoiseOfTheModelIsUsedIfTheMatchSelectsIt() {
    RobotModel model;
    model.noise.visionDistance = 0.2;
    Rig without = with(model);
    without.placeBall(1, 0);
    without.step();
    QVERIFY(std::abs(without.percepts[0].ball.distanceCm.value_or(0) - 100.0) < 1e-9);
    SimulationSettings settings;
    settings.noise.ofModel = true;
    Rig noisy = with(model, settings);
    noisy.placeBall(1, 0);
    noisy.step();
    QVERIFY(std::abs(noisy.percepts[0].ball.distanceCm.value_or(100.0) - 100.0) > 0.01);
  }

  void grassTakesTheSameSpeedEverySecond_data() {
    QTest::addColumn<double>("rate");
    QTest::newRow("60 Hz") << 60.0;
    QTest::newRow("500 Hz") << 500.0;
  }
  void grassTakesTheSameSpeedEverySecond() {
    QFETCH(double, rate);
    SimulationSettings settings = atRate(rate);
    settings.field.surface = {.deceleration = 0.5, .keptPerFrame = 1.0};
    Rig r(settings);
    r.placeBall(-2, 0, 1.5, 0);
    r.run(1.0);
    QVERIFY(std::abs(r.ball().velocity.x - 1.0) < 1e-9);
    r.run(4.0);
    // v^2 / 2a = 2.25 m
    QVERIFY(std::abs(r.ball().position.x - 0.25) < 1e-6);
    QCOMPARE(r.ball().velocity.x, 0.0);
  }

  void publishedListsIgnoredSettings() {
    SimulationSettings settings;
    settings.physics = "published";
    QVERIFY(ignoredSettings(settings, {}).empty());
    settings.noise.imuWhite = settings.noise.missedDetection = settings.noise.visionDelay = 0.1;
    settings.tickRate = 120;
    settings.rigidBody.postRestitution = 0.5;
    settings.field.surface.deceleration = 0.3;
    const RobotModel model = footed();
    const auto sentences = ignoredSettings(settings, {&model, 1});
    QCOMPARE(sentences.size(), std::size_t{7});
    for (const char* word : {"imu_white", "missed_detection", "vision_delay", "tick_rate",
                             "rigid_body", "rolling_deceleration", "model"}) {
      QVERIFY2(std::any_of(sentences.begin(), sentences.end(),
                           [&](const auto& s) { return s.find(word) != std::string::npos; }),
               word);
    }
    settings.physics = "rigid-body";
    QVERIFY(ignoredSettings(settings, {&model, 1}).empty());
  }

  void nonsenseIsRefused() {
    Rig r = with({});
    RobotModel model;
    model.mass = -1;
    const auto refused = r.simulation.setRobotModel({1}, model);
    QVERIFY(!refused);
    QCOMPARE(refused.error().context, std::string("robot_model.mass"));
    QVERIFY(!r.simulation.setRobotModel({7}, {}));
  }
};

PITCHBOARD_TEST(TestRobotModel)

}  // namespace tst_robot_model

#include "tst_robot_model.moc"
