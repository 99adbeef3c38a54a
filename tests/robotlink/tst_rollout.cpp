// SPDX-License-Identifier: GPL-3.0-or-later
// Rollouts: bodies and ball as in the rigid-body model, outcomes, seeds, threads, memory.
#include <QtTest>

#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include <robotlink/models/noise_presets.h>
#include <robotlink/models/robot_models.h>
#include <robotlink/rollout/rollouts.h>

#include "../support/allocation_counter.h"

namespace tst_rollout {

using namespace pitchboard;
using namespace pitchboard::rollout;
using std::numbers::pi;

namespace {

Player player(Side side, const char* behaviour) {
  Player made;
  made.side = side;
  made.behaviour.name = behaviour;
  made.model = link::loadRobotModel("kid-size").value();
  made.model.noise = {};
  return made;
}

Setup setupOf(std::vector<Player> players, double tickRate = 20.0) {
  Setup setup;
  setup.field = sim::fieldByName("kid-2020").value();
  setup.players = std::move(players);
  setup.tickRate = tickRate;
  return setup;
}

RobotBelief at(double x, double y, double yaw) {
  RobotBelief robot;
  robot.pose = {{x, y}, yaw};
  robot.sigma = robot.yawSigma = 0.0;
  return robot;
}

BallBelief ballAt(double x, double y, Velocity velocity = {}) {
  BallBelief ball;
  ball.place = {x, y};
  ball.sigma = ball.velocitySigma = 0.0;
  ball.velocity = velocity;
  return ball;
}

struct Row {
  std::vector<double> values;
  double operator[](Column column) const { return values[static_cast<std::size_t>(column)]; }
};

std::vector<std::uint64_t> seedsFrom(std::uint64_t first, std::size_t count) {
  std::vector<std::uint64_t> seeds(count);
  std::iota(seeds.begin(), seeds.end(), first);
  return seeds;
}

std::vector<double> play(Rollouts& rollouts, const Belief& belief, std::size_t count,
                         const PlayOptions& options) {
  std::vector<double> out(count * columnCount);
  const auto played = rollouts.play(belief, seedsFrom(1, count), options, out);
  if (!played) qFatal("%s", played.error().text().c_str());
  return out;
}

Row playOne(const Setup& setup, const Belief& belief, const PlayOptions& options) {
  auto rollouts = Rollouts::create(setup).value();
  return {play(rollouts, belief, 1, options)};
}

Setup threeAgainstThree() {
  Setup setup = setupOf({player(Side::Left, "striker"), player(Side::Left, "supporter"),
                         player(Side::Left, "keeper"), player(Side::Right, "striker"),
                         player(Side::Right, "supporter"), player(Side::Right, "keeper")});
  setup.noise = link::noisePreset("realistic").value();
  return setup;
}

Belief middleOfAGame() {
  Belief belief;
  belief.robots = {at(-1, 0, 0),   at(-2, 1.5, 0),  at(-4, 0, 0),
                   at(1.2, 0, pi), at(2, -1.5, pi), at(4, 0, pi)};
  for (RobotBelief& robot : belief.robots) robot.sigma = 0.1;
  belief.ball = ballAt(0, 0);
  belief.ball.sigma = 0.1;
  return belief;
}

bool sameBits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

}  // namespace

class TestRollout : public QObject {
  Q_OBJECT
 private slots:
  /// At any rate the ball rolls as far as the rigid-body model says.
  void ballRollsAsInAMatch() {
    const Setup usual = setupOf({player(Side::Left, "idle")});
    for (const double rate : {20.0, 60.0}) {
      Setup setup = usual;
      setup.tickRate = rate;
      Belief belief;
      belief.robots = {at(-3, 2, 0)};
      belief.ball = ballAt(0, 0, {0.9, 0.3});
      const Row row = playOne(setup, belief, {.seconds = 20.0});
      const double way = sim::rollingDistance(setup.field.surface, std::hypot(0.9, 0.3));
      QVERIFY(std::abs(std::hypot(row[Column::BallX], row[Column::BallY]) - way) < 1e-6);
      QCOMPARE(row[Column::BallVx], 0.0);
    }
  }

  void strikerScores() {
    Setup setup = setupOf({player(Side::Left, "striker")});
    Belief belief;
    belief.robots = {at(2.2, 0.0, 0.0)};
    belief.ball = ballAt(3.0, 0.0);
    const Row row = playOne(setup, belief, {.seconds = 30.0});
    QCOMPARE(row[Column::EndedBy], 1.0);
    QCOMPARE(row[Column::GoalsLeft], 1.0);
    QCOMPARE(row[Column::GoalsRight], 0.0);
    QCOMPARE(row[Column::LastTouch], 0.0);
    QVERIFY(row[Column::TimeToGoal] > 1.0 && row[Column::TimeToGoal] < 15.0);
    QCOMPARE(row[Column::Time], row[Column::TimeToGoal]);
  }

  /// A point every half second, the same as those of a look; a rollout that has ended stays there.
  void tracesShowThePathOfTheBall() {
    const Setup setup = setupOf({player(Side::Left, "idle")});
    Belief belief;
    belief.robots = {at(-3, 2, 0)};
    belief.ball = ballAt(3.0, 0.2, {3, 0});
    auto rollouts = Rollouts::create(setup).value();
    PlayOptions options{.seconds = 5.0};
    options.traceEvery = 0.5;
    QCOMPARE(tracePoints(options), std::size_t{11});
    std::vector<double> out(2 * columnCount);
    std::vector<TracePoint> trace(2 * tracePoints(options));
    QVERIFY(rollouts.play(belief, seedsFrom(1, 2), options, out, nullptr, trace));
    QCOMPARE(trace[0].ball, (Point{3.0, 0.2}));
    QCOMPARE(trace[0].goalsLeft, 0);
    QVERIFY(trace[1].ball.x > 3.5 && trace[1].ball.x < 4.5);
    QCOMPARE(trace[10].goalsLeft, 1);
    QCOMPARE(trace[10].ball.x, out[static_cast<std::size_t>(Column::BallX)]);
    QCOMPARE(trace[11].ball, trace[0].ball);  // the next rollout
    options.look = 0.5;
    const Row look = playOne(setup, belief, options);
    QCOMPARE(look[Column::LookX], trace[1].ball.x);
    trace.pop_back();
    QVERIFY(!rollouts.play(belief, seedsFrom(1, 2), options, out, nullptr, trace));
  }

  void goalsOutAndPosts() {
    const Setup setup = setupOf({player(Side::Left, "idle")});
    Belief belief;
    belief.robots = {at(-3, 2, 0)};
    const auto shot = [&](Point from, Velocity velocity) {
      belief.ball = ballAt(from.x, from.y, velocity);
      return playOne(setup, belief, {.seconds = 5.0});
    };
    Row row = shot({3.5, 0.2}, {3, 0});
    QCOMPARE(row[Column::GoalsLeft], 1.0);
    QCOMPARE(row[Column::EndedBy], 1.0);
    row = shot({-3.5, 0.2}, {-3, 0});
    QCOMPARE(row[Column::GoalsRight], 1.0);
    row = shot({3.5, 2.0}, {3, 0});
    QCOMPARE(row[Column::EndedBy], 2.0);
    QCOMPARE(row[Column::GoalsLeft], 0.0);
    QVERIFY(std::isnan(row[Column::TimeToGoal]));
    row = shot({0, 2.0}, {0, 3});
    QCOMPARE(row[Column::EndedBy], 2.0);
    // Against a post it comes back.
    row = shot({3.5, setup.field.goalWidth / 2}, {3, 0});
    QCOMPARE(row[Column::EndedBy], 0.0);
    QVERIFY(row[Column::BallX] < 4.4);
    // With goOn the game goes on after both.
    belief.ball = ballAt(3.5, 0.2, {3, 0});
    row = playOne(setup, belief, {.seconds = 5.0, .goOn = true});
    QCOMPARE(row[Column::EndedBy], 0.0);
    QCOMPARE(row[Column::GoalsLeft], 1.0);
    QCOMPARE(row[Column::Time], 5.0);
    QVERIFY(std::hypot(row[Column::BallX], row[Column::BallY]) < 1e-9);
  }

  void aRobotStopsTheBall() {
    const Setup setup = setupOf({player(Side::Left, "idle")});
    Belief belief;
    belief.robots = {at(2, 0, 0)};
    belief.ball = ballAt(0, 0, {2, 0});
    const Row row = playOne(setup, belief, {.seconds = 6.0});
    QVERIFY(row[Column::BallX] < 2.0 - 0.19 - setup.field.ballRadius + 1e-6);
    QCOMPARE(row[Column::LastTouch], 0.0);
    belief.robots[0].absent = true;
    QVERIFY(playOne(setup, belief, {.seconds = 6.0})[Column::BallX] > 2.5);
  }

  /// A fallen robot plays only after it has got up.
  void fallenRobotsGetUp() {
    const Setup setup = setupOf({player(Side::Left, "striker")});
    Belief belief;
    belief.robots = {at(2.2, 0.0, 0.0)};
    belief.ball = ballAt(3.0, 0.0);
    const double upright = playOne(setup, belief, {.seconds = 30.0})[Column::TimeToGoal];
    belief.robots[0].down = true;
    belief.robots[0].getsUpIn = 4.0;
    const double down = playOne(setup, belief, {.seconds = 30.0})[Column::TimeToGoal];
    QVERIFY(down > upright + 3.0);
  }

  /// The other team keeps away while a set play lasts.
  void setPlayHoldsTheOthersOff() {
    const Setup setup = setupOf({player(Side::Left, "striker"), player(Side::Right, "striker")});
    Belief belief;
    belief.robots = {at(-3, 2.5, 0), at(0.6, 0, pi)};
    belief.ball = ballAt(0, 0);
    QCOMPARE(playOne(setup, belief, {.seconds = 8.0})[Column::LastTouch], 1.0);
    belief.game.setPlay = SetPlay::DirectFreeKick;
    belief.game.setPlaySide = Side::Left;
    belief.game.setPlayLeft = 60.0;
    QCOMPARE(playOne(setup, belief, {.seconds = 8.0})[Column::LastTouch], -1.0);
  }

  void endsWithTheHalf() {
    const Setup setup = setupOf({player(Side::Left, "idle")});
    Belief belief;
    belief.robots = {at(0, 2, 0)};
    belief.game.secondsLeft = 3.0;
    QCOMPARE(playOne(setup, belief, {.seconds = 10.0})[Column::Time], 3.0);
  }

  void sameBitsForAnyThreadsAndTile() {
    const Belief belief = middleOfAGame();
    std::vector<double> first;
    constexpr std::pair<int, int> ways[] = {{1, 1}, {1, 8}, {2, 1}, {4, 3}, {3, 16}};
    for (const auto& [threads, tile] : ways) {
      auto rollouts = Rollouts::create(threeAgainstThree(), {threads, tile}).value();
      const auto out = play(rollouts, belief, 37, {.seconds = 6.0});
      if (first.empty()) first = out;
      QVERIFY2(sameBits(first, out), qPrintable(QString("%1 threads").arg(threads)));
      // And the same again in memory that has been used.
      QVERIFY(sameBits(first, play(rollouts, belief, 37, {.seconds = 6.0})));
    }
  }

  /// A row depends on its seed only, and different seeds differ.
  void rowsDependOnTheirSeeds() {
    auto rollouts = Rollouts::create(threeAgainstThree()).value();
    const Belief belief = middleOfAGame();
    const std::vector<std::uint64_t> some{9, 4}, others{4, 77, 9};
    std::vector<double> a(2 * columnCount), b(3 * columnCount);
    QVERIFY(rollouts.play(belief, some, {}, a));
    QVERIFY(rollouts.play(belief, others, {}, b));
    const auto row = [](const std::vector<double>& from, std::size_t i) {
      return std::vector<double>(from.begin() + static_cast<std::ptrdiff_t>(i * columnCount),
                                 from.begin() + static_cast<std::ptrdiff_t>((i + 1) * columnCount));
    };
    QVERIFY(sameBits(row(a, 0), row(b, 2)));
    QVERIFY(sameBits(row(a, 1), row(b, 0)));
    QVERIFY(!sameBits(row(b, 0), row(b, 1)));
  }

  void allocatesNothingInPlay() {
    if (!countsAllocations) QSKIP("the sanitizer has its own allocation functions");
    auto rollouts = Rollouts::create(threeAgainstThree(), {1, 4}).value();
    const Belief belief = middleOfAGame();
    const auto seeds = seedsFrom(1, 20);
    std::vector<double> out(seeds.size() * columnCount);
    QVERIFY(rollouts.play(belief, seeds, {.goOn = true}, out));
    const long before = allocations;
    const auto played = rollouts.play(belief, seeds, {.goOn = true}, out);
    QCOMPARE(allocations - before, 0L);
    QVERIFY(played);
  }

  /// What the belief is unsure of, the worlds differ in; a ball that has rolled since it was seen
  /// is farther on.
  void worldsAreSampledFromTheBelief() {
    const Setup setup = setupOf({player(Side::Left, "idle")});
    auto rollouts = Rollouts::create(setup).value();
    Belief belief;
    belief.robots = {at(-4, 2.5, 0)};
    belief.ball = ballAt(1, 0);
    belief.ball.sigma = 0.3;
    const auto spread = play(rollouts, belief, 2000, {.seconds = 0.1});
    for (const Column column : {Column::BallX, Column::BallY}) {
      double sum = 0.0, squares = 0.0;
      for (auto row = spread.begin(); row != spread.end(); row += columnCount) {
        const double value = row[static_cast<int>(column)];
        sum += value / 2000;
        squares += value * value / 2000;
      }
      QVERIFY(std::abs(sum - (column == Column::BallX ? 1.0 : 0.0)) < 0.03);
      QVERIFY(std::abs(std::sqrt(squares - sum * sum) - 0.3) < 0.02);
    }
    belief.ball = ballAt(0, 0, {1.0, 0.0});
    const double fresh = play(rollouts, belief, 1, {.seconds = 20})[6];
    belief.ball.age = 1.5;
    const auto aged = play(rollouts, belief, 1, {.seconds = 0.1});
    QVERIFY(aged[6] > 0.5);
    QVERIFY(std::abs(play(rollouts, belief, 1, {.seconds = 20})[6] - fresh) < 1e-6);
  }

  void everyColumnHasAName() {
    QSet<QByteArray> names;
    for (const OutcomeColumn& column : columns()) {
      QVERIFY(!column.name.empty() && !column.description.empty());
      names << QByteArray(column.name.data(), static_cast<qsizetype>(column.name.size()));
    }
    QCOMPARE(names.size(), static_cast<qsizetype>(columnCount));
  }

  void twentyTwoRobots() {
    std::vector<Player> players;
    Belief belief;
    for (int i = 0; i < 22; ++i) {
      const bool left = i < 11;
      players.push_back(
          player(left ? Side::Left : Side::Right, i % 11 == 0 ? "keeper" : "striker"));
      const double x = (left ? -1 : 1) * (0.5 + 0.3 * (i % 11));
      belief.robots.push_back(at(x, 0.5 * (i % 5) - 1, left ? 0 : pi));
    }
    belief.ball = ballAt(0, 0);
    Setup setup = setupOf(std::move(players));
    setup.body.falls = true;
    setup.noise = link::noisePreset("realistic").value();
    auto rollouts = Rollouts::create(setup).value();
    const auto out = play(rollouts, belief, 5, {.seconds = 10.0, .goOn = true});
    for (std::size_t row = 0; row < out.size(); row += columnCount) {
      QCOMPARE(out[row + static_cast<std::size_t>(Column::Time)], 10.0);
      QVERIFY(std::isfinite(out[row + static_cast<std::size_t>(Column::BallX)]));
    }
  }

  void refusesWhatMakesNoSense() {
    auto rollouts = Rollouts::create(threeAgainstThree()).value();
    std::vector<double> out(columnCount);
    const std::vector<std::uint64_t> one{1};
    const auto refuses = [&](const Belief& belief, const PlayOptions& options = {}) {
      const auto played = rollouts.play(belief, one, options, out);
      return !played && played.error().code == ErrorCode::InvalidArgument;
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    Belief belief = middleOfAGame();
    QVERIFY(!refuses(belief));
    belief.robots[2].pose.yaw = nan;
    QVERIFY(refuses(belief));
    belief.robots[2].absent = true;
    QVERIFY(!refuses(belief));
    belief.ball.sigma = -1.0;
    QVERIFY(refuses(belief));
    belief = middleOfAGame();
    belief.robots.pop_back();
    QVERIFY(refuses(belief));
    QVERIFY(refuses({}));
    QVERIFY(refuses(middleOfAGame(), {.seconds = 0.0}));
    QVERIFY(refuses(middleOfAGame(), {.seconds = nan}));
    out.pop_back();
    QVERIFY(refuses(middleOfAGame()));

    QVERIFY(!Rollouts::create(setupOf({})));
    QVERIFY(!Rollouts::create(setupOf({player(Side::Left, "naive")})));
    QVERIFY(!Rollouts::create(setupOf({player(Side::Left, "striker")}, 25.0)));
    QVERIFY(!Rollouts::create(threeAgainstThree(), {0, 1}));
    QVERIFY(!Rollouts::create(threeAgainstThree(), {1, 0}));
  }

  void stopsWhenCancelled() {
    auto rollouts = Rollouts::create(threeAgainstThree()).value();
    const std::atomic<bool> cancelled = true;
    std::vector<double> out(3 * columnCount);
    QVERIFY(rollouts.play(middleOfAGame(), seedsFrom(1, 3), {}, out, &cancelled));
    QVERIFY(std::isnan(out[0]));
    QVERIFY(std::isnan(out[2 * columnCount]));
  }
};

}  // namespace tst_rollout

QTEST_GUILESS_MAIN(tst_rollout::TestRollout)
#include "tst_rollout.moc"
