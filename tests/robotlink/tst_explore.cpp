// SPDX-License-Identifier: GPL-3.0-or-later
// Exploring a moment: what it takes from a frame, what it leaves out and says so, and that its
// answers are those of the rollouts.
#include <QtTest>

#include <cmath>
#include <numbers>
#include <numeric>

#include <robotlink/explore/explore.h>
#include <robotlink/models/robot_models.h>
#include <robotlink/rollout/rollouts.h>

namespace tst_explore {

using namespace pitchboard;
using namespace pitchboard::link;
using std::numbers::pi;

namespace {

RobotFrame robotAt(TeamColor team, int number, Pose pose, const char* behaviour) {
  RobotFrame robot;
  robot.identity = {RobotId{number + 10 * static_cast<int>(team)}, team, number,
                    info(team).facesLeft};
  robot.uid = uidOf(robot.identity.id);
  robot.key = keyOf(robot.identity);
  robot.name = robot.identity.name();
  robot.pose = pose;
  robot.belief = pose;
  robot.sigma = 0.05;
  robot.behaviour = behaviour;
  return robot;
}

void see(RobotFrame& robot, Point ball) {
  const Pose from = robot.belief.value_or(robot.pose);
  robot.ball =
      SeenBall{ball, distance(from.position, ball), direction(from.position, ball) - from.yaw};
}

/// A striker in front of the open right goal, the ball at its feet.
MatchFrame openGoal() {
  MatchFrame frame;
  FrameSettings settings;
  settings.field = sim::fieldByName("kid-2020").value();
  settings.physics = "rigid-body";
  frame.settings = std::make_shared<const FrameSettings>(settings);
  frame.robots = {robotAt(TeamColor::Blue, 2, {{3.0, 0.0}, 0.0}, "striker"),
                  robotAt(TeamColor::Red, 3, {{-3.5, 2.0}, pi}, "idle")};
  frame.snapshot.ball = {3.2, 0.0};
  frame.snapshot.time = 12.0;
  see(frame.robots[0], frame.snapshot.ball);
  return frame;
}

bool contains(const std::vector<std::string>& notes, const char* part) {
  return std::ranges::any_of(
      notes, [part](const std::string& note) { return note.find(part) != std::string::npos; });
}

ExploreOptions quick(double seconds = 15.0) {
  ExploreOptions options;
  options.seconds = seconds;
  options.maxRollouts = 200;
  options.rolloutsPerRound = 50;
  return options;
}

}  // namespace

class TestExplore : public QObject {
  Q_OBJECT
 private slots:
  void aStrikerAtAnOpenGoalScores() {
    const auto start = exploreStart(openGoal());
    QVERIFY(start);
    ExploreOptions options = quick();
    const auto result = explore(*start, options);
    QVERIFY(result);
    QVERIFY(result->last().goalLeft.value > 0.6);
    QVERIFY(result->last().goalRight.value < 0.1);
    // The same again, to the bit, and with two threads.
    options.threads = 2;
    const auto again = explore(*start, options);
    QCOMPARE(again->rollouts, result->rollouts);
    QCOMPARE(again->last().heat, result->last().heat);
  }

  void sharesHaveWilsonsInterval() {
    const Share share = shareOf(3.0, 10.0);
    QCOMPARE(share.value, 0.3);
    QVERIFY(std::abs(share.low - 0.10779) < 1e-5 && std::abs(share.high - 0.60322) < 1e-5);
    QCOMPARE(shareOf(0.0, 0.0).high, 1.0);
  }

  void answersAreThoseOfTheRollouts() {
    const auto start = exploreStart(openGoal());
    ExploreOptions options = quick(10.0);
    options.precision = 0.0;
    const auto result = explore(*start, options);
    QVERIFY(result);
    QCOMPARE(result->times.size(), std::size_t{11});
    auto rollouts = rollout::Rollouts::create(start->setup).value();
    std::vector<std::uint64_t> seeds(200);
    std::iota(seeds.begin(), seeds.end(), 1);
    std::vector<double> rows(200 * rollout::columnCount);
    rollout::PlayOptions play;
    play.seconds = 10.0;
    play.goOn = true;
    play.look = 7.0;
    QVERIFY(rollouts.play(start->belief, seeds, play, rows));
    int goals = 0;
    std::vector<double> heat(result->times[7].heat.size());
    const sim::FieldSpec& field = start->setup.field;
    for (auto row = rows.begin(); row != rows.end(); row += rollout::columnCount) {
      const auto at = [&](rollout::Column column) { return row[static_cast<int>(column)]; };
      goals += at(rollout::Column::GoalsLeft) > 0.0;
      const double x = std::floor((at(rollout::Column::LookX) + field.halfLength()) / 0.25);
      const double y = std::floor((at(rollout::Column::LookY) + field.halfWidth()) / 0.25);
      const int column = std::clamp(int(x), 0, result->columns - 1);
      const int line = std::clamp(int(y), 0, result->rows - 1);
      heat[std::size_t(line * result->columns + column)] += 1.0 / 200;
    }
    QCOMPARE(result->last().goalLeft.value, goals / 200.0);
    QVERIFY(goals > 0);
    for (std::size_t i = 0; i < heat.size(); ++i) {
      QVERIFY(std::abs(heat[i] - static_cast<double>(result->times[7].heat[i])) < 1e-6);
    }
    // Goals only become more.
    for (std::size_t i = 1; i < result->times.size(); ++i) {
      QVERIFY(result->times[i].goalLeft.value >= result->times[i - 1].goalLeft.value);
    }
    QCOMPARE(result->times[0].goalLeft.value, 0.0);
  }

  void truthIsUsedOnlyWhenAskedFor() {
    MatchFrame frame = openGoal();
    frame.robots[0].pose = {{2.0, 1.0}, 0.5};
    frame.snapshot.ballVelocity = {0.7, 0.0};
    frame.snapshot.ball = {2.4, 1.0};
    const auto believed = exploreStart(frame);
    QVERIFY(believed);
    QCOMPARE(believed->belief.robots[0].pose.position, (Point{3.0, 0.0}));
    QCOMPARE(believed->belief.robots[0].sigma, 0.05);
    QCOMPARE(believed->belief.ball.place, (Point{3.2, 0.0}));
    QVERIFY(believed->belief.ball.sigma > 0.0);
    QVERIFY(contains(believed->notes, "where they believe they are"));
    const auto truth = exploreStart(frame, {.useTruth = true, .base = nullptr, .earlier = {}});
    QVERIFY(truth);
    QCOMPARE(truth->belief.robots[0].pose.position, (Point{2.0, 1.0}));
    QCOMPARE(truth->belief.robots[0].sigma, 0.0);
    QCOMPARE(truth->belief.ball.velocity.x, 0.7);
    QVERIFY(contains(truth->notes, "true positions"));
  }

  void unknownRobotsAreLeftOutAndReported() {
    MatchFrame frame = openGoal();
    frame.robots.push_back(robotAt(TeamColor::Blue, 4, {{0, 0}, 0}, "supporter"));
    frame.robots.back().belief.reset();
    frame.robots.push_back(robotAt(TeamColor::Blue, 5, {{-4.3, 0}, 0}, ""));
    frame.robots.push_back(robotAt(TeamColor::Blue, 6, {{-1, 0}, 0}, "none"));
    frame.robots.back().penalty = Penalty{PenaltyKind::Pushing, 20};
    frame.robots.back().fallen = true;
    const auto start = exploreStart(frame);
    QVERIFY(start);
    QCOMPARE(start->names, (std::vector<std::string>{"B2", "R3", "B5", "B6"}));
    QVERIFY(contains(start->notes, "B4 does not know where it is"));
    QVERIFY(contains(start->notes, "B5 (keeper)"));
    QVERIFY(contains(start->notes, "stand still: B6"));
    QVERIFY(contains(start->notes, "Penalised robots do not come back: B6"));
    QVERIFY(start->belief.robots[3].absent && start->belief.robots[3].down);
    QCOMPARE(start->setup.players[1].side, rollout::Side::Right);
    QCOMPARE(start->setup.players[2].behaviour.name, std::string("keeper"));
  }

  void ballThatWasSeenEarlierHasAnAgeAndASpeed() {
    MatchFrame frame = openGoal();
    frame.robots[0].ball.reset();
    ExploreStartOptions options;
    QCOMPARE(exploreStart(frame, options).error().code, ErrorCode::NotFound);
    options.earlier = [&](double time) -> std::shared_ptr<const MatchFrame> {
      if (time > 11.1) return std::make_shared<MatchFrame>(frame);
      auto earlier = std::make_shared<MatchFrame>(frame);
      see(earlier->robots[0], {3.2 + (time - 11.0), 0.0});  // 1 m/s
      return earlier;
    };
    const auto start = exploreStart(frame, options);
    QVERIFY(start);
    QCOMPARE(start->belief.ball.age, 1.0);
    QVERIFY(std::abs(start->belief.ball.velocity.x - 1.0) < 1e-9);
    QVERIFY(start->belief.ball.velocitySigma > 0.0);
    QVERIFY(contains(start->notes, "last seen 1 s before"));
  }

  void whatCannotBeExploredIsRefused() {
    MatchFrame frame = openGoal();
    frame.robots.clear();
    QCOMPARE(exploreStart(frame).error().code, ErrorCode::NotFound);
    const auto start = exploreStart(openGoal());
    ExploreOptions options = quick(0.0);
    QCOMPARE(explore(*start, options).error().code, ErrorCode::InvalidArgument);
    options = quick();
    options.maxRollouts = 0;
    QCOMPARE(explore(*start, options).error().code, ErrorCode::InvalidArgument);
  }

  void cancelKeepsWholeRounds() {
    const auto start = exploreStart(openGoal());
    std::atomic<bool> cancelled{true};
    ExploreOptions options = quick();
    options.precision = 0.0;
    QCOMPARE(explore(*start, options, {}, &cancelled).error().code, ErrorCode::Conflict);
    cancelled = false;
    int rounds = 0;
    double done = 0.0;
    const auto result = explore(
        *start, options,
        [&](double share, const ExploreResult& soFar) {
          done = share;
          if (soFar.rollouts == 100) cancelled = true;  // in the middle of the third
          return ++rounds < 10;
        },
        &cancelled);
    QVERIFY(result);
    QCOMPARE(result->rollouts, std::size_t{100});
    QCOMPARE(done, 0.5);
  }
};

PITCHBOARD_TEST(TestExplore)

}  // namespace tst_explore

#include "tst_explore.moc"
