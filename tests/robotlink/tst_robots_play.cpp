// SPDX-License-Identifier: GPL-3.0-or-later
// The reference robots in the simulated match, in lock-step: localization in closed loop, and
// soccer. A fast part of what the experiment soccer-4v4 measures (docs/performance.md).
#include <QtTest>

#include <numbers>

#include <robotlink/models/robot_models.h>

#include "../support/measured_match.h"

namespace tst_robots_play {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

Result<SimulatedMatch> make(const Scenario& scenario, int particles = 5000) {
  MatchOptions options;
  options.process.particles = particles;
  return SimulatedMatch::create(scenario, options);
}

void run(SimulatedMatch& match, double seconds) {
  for (int i = 0; i < static_cast<int>(seconds * 60); ++i) match.tick();
}

double beliefError(const SimulatedMatch& match, int robot, double* yaw = nullptr) {
  for (const auto& r : match.simulation().snapshot().robots) {
    if (r.identity.id.value == robot) return poseError(match, r, yaw);
  }
  return 1e9;
}

/// One robot alone on the field.
Scenario alone(const std::string& behaviour, TeamColor team, const Pose& pose,
               const std::string& noise) {
  Scenario scenario = soccerMatch(noise, 5).value();
  scenario.robots.resize(1);
  ScenarioRobot& robot = scenario.robots[0];
  robot.identity = {RobotId{1}, team, 1, info(team).facesLeft};
  robot.pose = pose;
  robot.behaviour = behaviour;
  return scenario;
}

}  // namespace

class TestRobotsPlay : public QObject {
  Q_OBJECT
 private slots:
  void localizationOverAMatchWithThePapersNoise() {
    auto match = make(soccerMatch("paper", 3).value()).value();
    const MatchMeasure m = playMatch(match, 180);
    const double position = quantile(m.positionError, 0.5), yaw = quantile(m.yawError, 0.5);
    qInfo("median error %.1f cm, %.2f deg", 100 * position, degreesFromRadians(yaw));
    QVERIFY(position < 0.25);
    QVERIFY(yaw < radiansFromDegrees(5));
  }

  void localizationConvergesFromAnUnknownStart() {
    std::vector<double> errors, yaws;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      auto match = make(soccerMatch("paper", seed).value()).value();
      run(match, 20);
      for (int robot = 1; robot <= 6; ++robot) {
        double yaw = 0;
        errors.push_back(beliefError(match, robot, &yaw));
        yaws.push_back(yaw);
      }
    }
    qInfo("after 20 s: median %.2f m, worst of 60 %.2f m", quantile(errors, 0.5),
          quantile(errors, 1));
    QVERIFY(quantile(errors, 0.5) < 0.25);
    QVERIFY(quantile(errors, 1) < 0.6);
    QVERIFY(quantile(yaws, 1) < radiansFromDegrees(8));
  }

  // A robot that was not told where it attacks finds it out, and never scores on its own goal.
  void aRobotFindsItsSide_data() {
    QTest::addColumn<bool>("left");
    QTest::addColumn<double>("x");  // attacking to the right
    QTest::newRow("starts facing right") << false << -2.0;
    QTest::newRow("starts facing left") << true << -2.0;
    QTest::newRow("starts facing right, its goal behind the ball") << false << 2.0;
    QTest::newRow("starts facing left, its goal behind the ball") << true << 2.0;
  }
  void aRobotFindsItsSide() {
    QFETCH(bool, left);
    QFETCH(double, x);
    int goals = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const double side = left ? -1.0 : 1.0;
      Scenario scenario = alone("striker", left ? TeamColor::Red : TeamColor::Blue,
                                {{side * x, 0.5}, left ? std::numbers::pi : 0.0}, "realistic");
      scenario.settings.seed = seed;
      scenario.settings.afterGoal = sim::AfterGoal::StopClock;
      MatchOptions options;
      options.process.particles = 500;
      options.announceSides = false;
      auto match = SimulatedMatch::create(scenario, options).value();
      std::vector<MatchEvent> events;
      for (int i = 0; i < 120 * 60 && match.simulation().state().clockRunning; ++i) match.tick();
      match.drainEvents(events);
      for (const MatchEvent& event : events) {
        if (event.kind != MatchEventKind::Goal) continue;
        ++goals;
        QVERIFY2((event.side == Side::Right) == left,
                 qPrintable(QString("seed %1: an own goal").arg(seed)));
      }
    }
    qInfo("%d goals in 20 matches", goals);
    QVERIFY(goals >= 10);
  }

  void localizationRecoversWhenTheUserDragsARobot() {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      auto match = make(soccerMatch("paper", seed).value()).value();
      run(match, 30);
      QVERIFY(match.simulation().placeRobot(RobotId{1}, {{3.5, -2.2}, 2.0}));
      QVERIFY(match.simulation().placeRobot(RobotId{5}, {{-3.0, 2.0}, -1.0}));
      match.tick();
      QVERIFY(beliefError(match, 1) > 1.0);
      run(match, 20);
      QVERIFY2(beliefError(match, 1) < 0.5,
               qPrintable(QString("seed %1: %2").arg(seed).arg(beliefError(match, 1))));
      QVERIFY2(beliefError(match, 5) < 0.5,
               qPrintable(QString("seed %1: %2").arg(seed).arg(beliefError(match, 5))));
    }
  }

  void aLonelyStrikerScores_data() {
    QTest::addColumn<int>("team");
    QTest::addColumn<double>("x");
    QTest::addColumn<double>("heading");
    QTest::newRow("blue to the right") << static_cast<int>(TeamColor::Blue) << -2.0 << 0.0;
    QTest::newRow("red to the left") << static_cast<int>(TeamColor::Red) << 2.0 << std::numbers::pi;
    QTest::newRow("blue starts on the wrong side of the ball")
        << static_cast<int>(TeamColor::Blue) << 1.5 << 0.0;
  }
  void aLonelyStrikerScores() {
    QFETCH(int, team);
    QFETCH(double, x);
    QFETCH(double, heading);
    const auto color = static_cast<TeamColor>(team);
    auto match = make(alone("striker", color, {{x, 0.5}, heading}, "realistic")).value();
    const MatchMeasure m = playMatch(match, 180);
    const bool right = color == TeamColor::Blue;
    qInfo("first goal after %.0f s", m.firstGoal);
    QVERIFY((right ? m.left : m.right) > 0);
    QCOMPARE(right ? m.right : m.left, 0);  // never into its own goal
  }

  // Pressed, it kicks forward without turning to the goal; a strong kick would cross the touch
  // line.
  void aPressedStrikerKeepsTheBallOnTheField_data() {
    QTest::addColumn<double>("heading");
    for (const double heading : {20.0, 30.0, 40.0}) QTest::addRow("%g degrees", heading) << heading;
  }
  void aPressedStrikerKeepsTheBallOnTheField() {
    QFETCH(double, heading);
    Scenario scenario = soccerMatch("none", 1).value();
    scenario.settings.field = sim::fieldByName("kid-2020").value();
    scenario.robots.resize(2);
    for (ScenarioRobot& robot : scenario.robots) robot.model = loadRobotModel("kid-size").value();
    scenario.robots[0].pose = {{0.0, 1.5}, radiansFromDegrees(heading)};
    scenario.robots[0].behaviour = "striker";
    scenario.robots[1].identity = {RobotId{2}, TeamColor::Red, 1, true};
    scenario.robots[1].pose = {{0.8, 1.6}, std::numbers::pi};
    scenario.robots[1].behaviour = noBehaviour;
    scenario.ball = {0.3, 1.72};
    auto match = make(scenario).value();
    int out = 0;
    for (int i = 0; i < 40 * 60 && match.simulation().state().score == sim::Score{}; ++i) {
      match.tick();
      for (const sim::Event& event : match.simulation().events()) {
        out += event.kind == sim::EventKind::BallOut;
      }
    }
    QCOMPARE(out, 0);
    QCOMPARE(match.simulation().state().score.left, 1);
  }

  void keeperClearsAndNeverScoresAnOwnGoal() {
    Scenario scenario = alone("keeper", TeamColor::Blue, {{-4.0, 0.0}, 0.0}, "realistic");
    scenario.ball = {-3.7, 0.4};
    auto match = make(scenario).value();
    const MatchMeasure m = playMatch(match, 120);
    QVERIFY(m.kicks > 0);
    QCOMPARE(m.right, 0);
    QVERIFY(match.simulation().snapshot().ball.x > -3.2);
  }

  void keeperStaysBeforeItsGoal() {
    Scenario scenario = alone("keeper", TeamColor::Blue, {{-3.0, 1.0}, 0.0}, "realistic");
    scenario.ball = {-2.0, 1.5};
    auto match = make(scenario).value();
    run(match, 60);
    const Pose pose = match.simulation().robotPose(RobotId{1}).value();
    QVERIFY(pose.position.x < -3.5);
    QVERIFY(std::abs(pose.position.y) < 0.9);
    QVERIFY(pose.position.y > 0.05);  // towards the ball's side
  }

  void theRefereeIsObeyed_data() {
    QTest::addColumn<int>("word");
    QTest::newRow("stop") << 1;
    QTest::newRow("set") << 12;
    QTest::newRow("nobody spoke") << 0;
  }
  void theRefereeIsObeyed() {
    QFETCH(int, word);
    Scenario scenario = soccerMatch("none", 1).value();
    scenario.writes = {{RobotId{}, "COM_REFEREE", static_cast<double>(word), 0.0}};
    auto match = make(scenario, 500).value();
    const MatchMeasure m = playMatch(match, 30);
    QCOMPARE(m.walked, 0.0);
  }

  void readyWalksToTheKickOffPositions() {
    Scenario scenario = soccerMatch("none", 1).value();
    scenario.writes = {{RobotId{}, "COM_REFEREE", 11.0, 0.0}};
    auto match = make(scenario).value();
    run(match, 45);
    for (const auto& robot : match.simulation().snapshot().robots) {
      const bool blue = robot.identity.team == TeamColor::Blue;
      QVERIFY((blue ? -1 : 1) * robot.pose.position.x > 0.5);  // own half
      if (robot.identity.number == 1) {
        QVERIFY(std::hypot(std::abs(robot.pose.position.x) - 1.1, robot.pose.position.y) < 0.5);
      }
    }
  }
  void onlyOneOfTwoStrikersTakesTheBall() {
    Scenario scenario = soccerMatch("realistic", 2).value();
    scenario.robots.resize(3);
    for (ScenarioRobot& robot : scenario.robots) robot.behaviour = "striker";
    auto match = make(scenario, 500).value();
    run(match, 10);
    const IntVar state = *VariableCatalog::published().intVar("DECISION_STATE");
    int crowded = 0, samples = 0;
    for (int second = 0; second < 120; ++second) {
      run(match, 1);
      int atBall = 0;
      for (int n = 1; n <= 3; ++n) atBall += match.blackboard(RobotId{n})->read(state) == 3;
      crowded += atBall > 1;
      ++samples;
    }
    qInfo("more than one at the ball in %d of %d seconds", crowded, samples);
    QVERIFY(crowded * 4 < samples);
  }

  void twoTeamsScoreAndSeldomCollide() {
    int goals = 0, scored = 0;
    double touching = 0;
    constexpr int seeds = 4;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      auto match = make(soccerMatch("realistic", seed).value(), 500).value();
      const MatchMeasure m = playMatch(match, 600);
      goals += m.left + m.right;
      scored += m.left + m.right > 0;
      touching += m.touchShare / seeds;
    }
    qInfo("%d goals, %d of %d matches with one, touching %.1f %% of the time", goals, scored, seeds,
          100 * touching);
    QVERIFY(2 * scored > seeds);
    QVERIFY(touching < 0.05);
  }

  // In every team, supporters take different places, one on each side.
  void supportersTakeAPlaceEach_data() {
    QTest::addColumn<QStringList>("team");
    QTest::newRow("no striker") << QStringList{"keeper", "supporter", "supporter", "idle"};
    QTest::newRow("three") << QStringList{"keeper", "supporter", "supporter", "supporter"};
    QTest::newRow("with a striker") << QStringList{"keeper", "supporter", "supporter", "striker"};
    QTest::newRow("four") << QStringList{"supporter", "supporter", "supporter", "supporter"};
  }
  void supportersTakeAPlaceEach() {
    QFETCH(QStringList, team);
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      Scenario scenario = soccerMatch("paper", seed).value();
      scenario.robots.resize(1);
      const ScenarioRobot model = scenario.robots[0];
      scenario.robots.clear();
      for (int i = 0; i < 4; ++i) {
        ScenarioRobot robot = model;
        robot.identity = {RobotId{i + 1}, TeamColor::Blue, i + 1, false};
        // All on one side of the field.
        robot.pose = {{-3.8 + 0.3 * i, 1.0 + 0.4 * ((i * 7 + static_cast<int>(seed)) % 4)}, 0.0};
        robot.behaviour = team[i].toStdString();
        scenario.robots.push_back(robot);
      }
      scenario.writes = {{RobotId{}, "COM_REFEREE", 11.0, 0.0}};
      auto match = make(scenario, 500).value();
      run(match, 60);
      int left = 0, right = 0;
      const sim::Snapshot now = match.simulation().snapshot();
      for (std::size_t a = 0; a < now.robots.size(); ++a) {
        const Point at = now.robots[a].pose.position;
        if (team[static_cast<int>(a)] != "supporter") continue;
        left += at.y > 0.7;
        right += at.y < -0.7;
        for (std::size_t b = 0; b < now.robots.size(); ++b) {
          if (b == a) continue;
          const double apart = distance(at, now.robots[b].pose.position);
          // An idle robot may stand near a place, but not against the robot there.
          const double least = team[static_cast<int>(b)] == "supporter" ? 0.5 : 0.33;
          QVERIFY2(apart > least, qPrintable(QString("seed %1: %2 and %3 are %4 m apart")
                                                 .arg(seed)
                                                 .arg(a + 1)
                                                 .arg(b + 1)
                                                 .arg(apart)));
        }
      }
      QVERIFY2(
          left == 1 && right == 1,
          qPrintable(
              QString("seed %1: %2 on the left, %3 on the right").arg(seed).arg(left).arg(right)));
    }
  }

  void sameSeedSameMatch() {
    const auto hash = [](std::uint64_t seed) {
      auto match = make(soccerMatch("realistic", seed).value(), 500).value();
      run(match, 60);
      return match.simulation().hash();
    };
    QCOMPARE(hash(7), hash(7));
    QVERIFY(hash(7) != hash(8));
  }
};

PITCHBOARD_TEST(TestRobotsPlay)

}  // namespace tst_robots_play

#include "tst_robots_play.moc"
