// SPDX-License-Identifier: GPL-3.0-or-later
#include <QtTest>
#include <cmath>
#include <limits>

#include <base/angles.h>
#include <simcore/simulation/simulation.h>
#include <simcore/world/field_lines.h>

namespace tst_simulation {

using namespace pitchboard;
using namespace pitchboard::sim;

namespace {

Simulation make(const std::string& physics) {
  SimulationSettings settings;
  settings.physics = physics;
  return Simulation::create(settings).value();
}

RobotIdentity blue(int number) {
  return {RobotId{number}, TeamColor::Blue, number, false};
}

/// Steps with the same command for every robot.
void run(Simulation& simulation, const RobotCommand& command, int ticks) {
  const std::vector<RobotCommand> commands(simulation.robotCount(), command);
  std::vector<Percepts> percepts(simulation.robotCount());
  for (int i = 0; i < ticks; ++i) simulation.step(commands, percepts);
}

void addModelRows() {
  QTest::addColumn<QString>("physics");
  for (const PhysicsModelInfo& model : physicsModels()) {
    QTest::newRow(std::string(model.name).c_str())
        << QString::fromStdString(std::string(model.name));
  }
}

}  // namespace

class TestSimulation : public QObject {
  Q_OBJECT
 private slots:
  void settingsThatCannotWorkAreRefused_data() {
    QTest::addColumn<SimulationSettings>("settings");
    QTest::addColumn<QString>("text");
    const auto row = [](const char* name, auto change, const char* text) {
      SimulationSettings settings;
      change(settings);
      QTest::newRow(name) << settings << QString(text);
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    row(
        "unknown model", [](auto& s) { s.physics = "magic"; },
        "There is no physics model called \"magic\". Known models: rigid-body, published.");
    row(
        "tick rate 0", [](auto& s) { s.tickRate = 0; }, "tick_rate: ");
    row(
        "tick rate nan", [nan](auto& s) { s.tickRate = nan; }, "tick_rate: ");
    row(
        "field without length", [](auto& s) { s.field.length = 0; },
        "length must lie between 1 and 200 metres, and is 0");
    row(
        "goal wider than field", [](auto& s) { s.field.goalWidth = 7; },
        "the goal is wider than the field");
    row(
        "goal behind the wall", [](auto& s) { s.field.goalDepth = 1; },
        "the goal is deeper than the border");
    row(
        "negative noise", [](auto& s) { s.noise.forward = -0.1; }, "noise.forward: ");
    row(
        "probability over 1", [](auto& s) { s.noise.missedDetection = 1.5; },
        "noise.missed_detection: ");
    row(
        "weightless ball", [](auto& s) { s.rigidBody.ballMass = 0; }, "rigid_body.ball_mass: ");
  }
  void settingsThatCannotWorkAreRefused() {
    QFETCH(SimulationSettings, settings);
    QFETCH(QString, text);
    const auto simulation = Simulation::create(settings);
    QVERIFY(!simulation.has_value());
    QVERIFY2(QString::fromStdString(simulation.error().text()).contains(text),
             simulation.error().text().c_str());
  }

  void everyBuiltInFieldCanBePlayedOn() {
    QVERIFY(builtInFields().size() >= 8);
    for (const FieldSpec& field : builtInFields()) {
      const auto valid = validate(field);
      QVERIFY2(valid.has_value(), valid ? "" : valid.error().text().c_str());
      QCOMPARE(fieldByName(field.name).value(), field);
    }
    // The drawings of the league of 2026 (HSL-Rules, figs/FieldGenerator).
    const FieldSpec large = fieldByName("large-2026").value();
    QCOMPARE(large.goalAreaWidth, 5.0);
    QCOMPARE(large.lineWidth, 0.12);
    QCOMPARE(large.markDiameter, 0.15);
    QCOMPARE(large.cornerArcRadius, 1.0);
    QCOMPARE(fieldByName("middle-2026")->cornerArcRadius, 0.5);
    QCOMPARE(fieldByName("small-2026")->cornerArcRadius, 0.0);
    // Lengths are measured to the outer edges of lines.
    const FieldLines lines = fieldLines(large, large.lineWidth);
    QCOMPARE(lines.arcRadius, 0.94);
    QCOMPARE(lines.markRadius, 0.075);
    QCOMPARE(fieldLines(fieldByName("kid-2020").value(), 0.05).markRadius, 0.0);
    QVERIFY(!fieldByName("moon").has_value());
    QVERIFY(fieldByName("moon").error().message.find("kid-2020") != std::string::npos);
  }

  void robotsAreAddedPlacedAndRemoved_data() { addModelRows(); }
  void robotsAreAddedPlacedAndRemoved() {
    QFETCH(QString, physics);
    Simulation simulation = make(physics.toStdString());
    QVERIFY(simulation.addRobot(blue(1), {{-1, 0.5}, 0.25}).has_value());
    QVERIFY(simulation.addRobot(blue(3), {{2, -0.5}, -2.5}).has_value());
    QVERIFY(!simulation.addRobot(blue(1), {}).has_value());
    QVERIFY(!simulation.addRobot(blue(0), {}).has_value());
    QVERIFY(!simulation.addRobot(blue(65), {}).has_value());
    QVERIFY(!simulation.placeRobot(RobotId{2}, {}).has_value());
    QVERIFY(!simulation.removeRobot(RobotId{2}).has_value());
    const double nan = std::numeric_limits<double>::quiet_NaN();
    QVERIFY(!simulation.placeRobot(RobotId{1}, {{nan, 0}, 0}).has_value());
    QVERIFY(!simulation.placeBall({nan, 0}).has_value());

    QVERIFY(simulation.placeRobot(RobotId{3}, {{1.5, 1.25}, 3.0}).has_value());
    const Pose pose = simulation.robotPose(RobotId{3}).value();
    QVERIFY(std::abs(pose.position.x - 1.5) < 1e-12);
    QVERIFY(std::abs(pose.position.y - 1.25) < 1e-12);
    QVERIFY(std::abs(pose.yaw - 3.0) < 1e-12);

    QVERIFY(simulation.placeRobot(RobotId{3}, {{100, -100}, 0}).has_value());
    const Pose moved = simulation.robotPose(RobotId{3}).value();
    QVERIFY(moved.position.x <= 4.5 + 0.7 && moved.position.y >= -3.0 - 0.7);

    QVERIFY(simulation.removeRobot(RobotId{1}).has_value());
    QCOMPARE(simulation.robotCount(), std::size_t{1});
    QCOMPARE(simulation.snapshot().robots[0].identity.id.value, 3);
    run(simulation, RobotCommand{}, 10);
  }

  void snapshotIsInTheStudiosFrame_data() { addModelRows(); }
  void snapshotIsInTheStudiosFrame() {
    QFETCH(QString, physics);
    Simulation simulation = make(physics.toStdString());
    QVERIFY(simulation.addRobot(blue(1), {{-2.0, 1.0}, radiansFromDegrees(90)}).has_value());
    QVERIFY(simulation.placeBall({1.0, -0.5}, {0.6, 1.2}).has_value());
    Snapshot snapshot = simulation.snapshot();
    QVERIFY(std::abs(snapshot.ball.x - 1.0) < 1e-12 && std::abs(snapshot.ball.y + 0.5) < 1e-12);
    QVERIFY(std::abs(snapshot.ballVelocity.y - 1.2) < 1e-12);
    RobotCommand walk;
    walk.actionA = 1;
    run(simulation, walk, 120);
    snapshot = simulation.snapshot();
    // It faces up, so it walked up; 0.18 m/s for nearly two seconds.
    QVERIFY(std::abs(snapshot.robots[0].pose.position.x + 2.0) < 1e-6);
    QVERIFY(snapshot.robots[0].pose.position.y > 1.3 && snapshot.robots[0].pose.position.y < 1.37);
    QVERIFY(snapshot.robots[0].velocity.y > 0.17);
    QCOMPARE(snapshot.robots[0].action, 1);
    QVERIFY(snapshot.robots[0].statistics.distanceWalked > 0.3);
    QCOMPARE(snapshot.tick, std::uint64_t{120});
    QCOMPARE(snapshot.time, 2.0);
  }

  void savedMomentGoesOnIdentically_data() { addModelRows(); }
  void savedMomentGoesOnIdentically() {
    QFETCH(QString, physics);
    SimulationSettings settings;
    settings.physics = physics.toStdString();
    settings.noise.forward = settings.noise.sideways = 0.002;
    settings.noise.rotation = settings.noise.imuDrift = 0.001;
    Simulation first = Simulation::create(settings).value();
    for (int i = 1; i <= 4; ++i) {
      QVERIFY(first.addRobot(blue(i), {{-0.6 + 0.25 * i, 0.01 * i}, 0.3 * i}).has_value());
    }
    RobotCommand walk;
    walk.actionA = 1;
    run(first, walk, 200);
    const WorldState saved = first.state();
    QCOMPARE(stateHash(saved), first.hash());

    Simulation second = make("rigid-body");
    QVERIFY(second.restore(saved).has_value());
    for (int i = 0; i < 300; ++i) {
      run(first, walk, 1);
      run(second, walk, 1);
      QCOMPARE(second.hash(), first.hash());
    }
    QVERIFY(first.state() == second.state());
    QVERIFY(stateHash(saved) != first.hash());
  }

  void savedMomentOfAnotherKindIsRefused() {
    Simulation simulation = make("published");
    WorldState state = simulation.state();
    state.settings.physics = "rigid-body";
    QVERIFY(!simulation.restore(state).has_value());
    state = simulation.state();
    state.robots.resize(1);
    QVERIFY(!simulation.restore(state).has_value());
  }

  void anotherRobotDoesNotChangeTheNoise_data() { addModelRows(); }
  void anotherRobotDoesNotChangeTheNoise() {
    QFETCH(QString, physics);
    const auto walkFar = [&](bool withSecond) {
      SimulationSettings settings;
      settings.physics = physics.toStdString();
      settings.noise.forward = settings.noise.sideways = 0.002;
      settings.noise.rotation = 0.002;
      Simulation simulation = Simulation::create(settings).value();
      if (withSecond) (void)simulation.addRobot(blue(1), {{3, 2}, 0});
      (void)simulation.addRobot(blue(7), {{-3, -1}, 0});
      RobotCommand walk;
      walk.actionA = 1;
      run(simulation, walk, 300);
      return simulation.robotPose(RobotId{7}).value();
    };
    QVERIFY(walkFar(false) == walkFar(true));
  }

  void anotherPhysicsGoesOnFromTheMoment_data() { addModelRows(); }
  void anotherPhysicsGoesOnFromTheMoment() {
    QFETCH(QString, physics);
    const std::string other = physics == "published" ? "rigid-body" : "published";
    SimulationSettings settings;
    settings.physics = physics.toStdString();
    settings.noise.imuDrift = 0.01;
    Simulation simulation = Simulation::create(settings).value();
    (void)simulation.addRobot(blue(1), {{-2, 1}, 0.5});
    (void)simulation.addRobot({RobotId{2}, TeamColor::Red, 1, true}, {{2, -1}, 3.0});
    (void)simulation.placeBall({0.3, 0.2}, {0.5, -0.2});
    simulation.setScore({2, 1});
    RobotCommand walk;
    walk.actionA = 1;
    walk.searchOn = 1;
    run(simulation, walk, 90);
    const Snapshot before = simulation.snapshot();
    const WorldState saved = simulation.state();
    std::vector<Percepts> felt(2), feltAfter(2);
    const std::vector<RobotCommand> stop(2);
    simulation.step(stop, felt);
    QVERIFY(simulation.restore(saved).has_value());
    QVERIFY(!simulation.setPhysics("magic").has_value());
    QVERIFY(simulation.state() == saved);

    QVERIFY(simulation.setPhysics(other).has_value());
    QCOMPARE(simulation.state().settings.physics, other);
    const Snapshot after = simulation.snapshot();
    QCOMPARE(after.tick, before.tick);
    QVERIFY(after.score == before.score);
    QVERIFY(distance(after.ball, before.ball) < 1e-9);
    QVERIFY(std::hypot(after.ballVelocity.x - before.ballVelocity.x,
                       after.ballVelocity.y - before.ballVelocity.y) < 1e-9);
    for (std::size_t i = 0; i < 2; ++i) {
      QVERIFY(after.robots[i].identity == before.robots[i].identity);
      QVERIFY(after.robots[i].statistics == before.robots[i].statistics);
      QVERIFY(distance(after.robots[i].pose.position, before.robots[i].pose.position) < 1e-9);
      QVERIFY(std::abs(wrapToPi(after.robots[i].pose.yaw - before.robots[i].pose.yaw)) < 1e-9);
      QVERIFY(std::abs(wrapToPi(after.robots[i].headYaw - before.robots[i].headYaw)) < 1e-9);
      QCOMPARE(after.robots[i].velocity, Velocity{});
    }
    // Robots keep their heading: the error of their IMU goes on from where it was.
    simulation.step(stop, feltAfter);
    for (std::size_t i = 0; i < 2; ++i) {
      const double turned = wrapToPi(feltAfter[i].imu.eulerZ - felt[i].imu.eulerZ);
      QVERIFY2(std::abs(turned) < 0.1, qPrintable(QString::number(turned)));
    }
    // The state is whole: it is saved, restored and played on as any other.
    const WorldState kept = simulation.state();
    run(simulation, walk, 60);
    const std::uint64_t hash = simulation.hash();
    QVERIFY(simulation.snapshot().robots[0].statistics.distanceWalked >
            before.robots[0].statistics.distanceWalked);
    Simulation again = make("rigid-body");
    QVERIFY(again.restore(kept).has_value());
    run(again, walk, 60);
    QCOMPARE(again.hash(), hash);
    QVERIFY(again.restore(saved).has_value());
    QCOMPARE(again.state().settings.physics, physics.toStdString());
  }

  void unknownActionIsAStopAndCounted_data() { addModelRows(); }
  void unknownActionIsAStopAndCounted() {
    QFETCH(QString, physics);
    const Pose away{{-2.0, 1.0}, 0.0};
    Simulation simulation = make(physics.toStdString());
    QVERIFY(simulation.addRobot(blue(1), away).has_value());
    RobotCommand command;
    command.actionA = 99;
    run(simulation, command, 1);
    const Snapshot snapshot = simulation.snapshot();
    QCOMPARE(snapshot.robots[0].statistics.unknownActions, 1U);
    QCOMPARE(snapshot.robots[0].statistics.lastUnknownAction, 99);
    QCOMPARE(snapshot.robots[0].velocity, Velocity{});
    QCOMPARE(simulation.events().size(), std::size_t{1});
    QVERIFY(simulation.events()[0].kind == EventKind::UnknownAction);
    QCOMPARE(simulation.events()[0].value, 99);
    run(simulation, command, 60);
    const Pose pose = simulation.robotPose(RobotId{1}).value();
    QVERIFY(std::hypot(pose.position.x + 2.0, pose.position.y - 1.0) < 1e-12);
  }

  void goalsCountWhileTheClockRuns_data() { addModelRows(); }
  void goalsCountWhileTheClockRuns() {
    QFETCH(QString, physics);
    SimulationSettings settings;
    settings.physics = physics.toStdString();
    settings.afterGoal = AfterGoal::StopClock;
    Simulation simulation = Simulation::create(settings).value();
    simulation.setClockRunning(true);
    (void)simulation.placeBall({4.0, 0.0}, {6.0, 0.0});
    run(simulation, {}, 60);
    QCOMPARE(simulation.state().score.left, 1);
    QCOMPARE(simulation.state().score.right, 0);
    QVERIFY(!simulation.state().clockRunning);
    (void)simulation.placeBall({-4.0, 0.0}, {-6.0, 0.0});
    run(simulation, {}, 60);
    QCOMPARE(simulation.state().score.right, 0);
  }
};

PITCHBOARD_TEST(TestSimulation)

}  // namespace tst_simulation

#include "tst_simulation.moc"
