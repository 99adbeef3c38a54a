// SPDX-License-Identifier: GPL-3.0-or-later
// How a match is played: who is at the ball, removals, states. Made moments, no match.
#include <QtTest>

#include "match_watch.h"

namespace tst_match_watch {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

constexpr int rate = 60;

/// Three blue robots, of which the first is the goalkeeper, and a red one; ten samples a second.
struct Game {
  Game() {
    world.game.emplace();
    world.game->state = PlayState::Playing;
    world.game->teams[1].colour = TeamColor::Red;
    for (int id = 1; id <= 4; ++id) {
      const TeamColor team = id < 4 ? TeamColor::Blue : TeamColor::Red;
      const int shirt = id < 4 ? id : 1;
      world.robots.push_back({RobotId{id}, team, shirt, false});
      world.game->teams[id < 4 ? 0 : 1].shirts[static_cast<std::size_t>(shirt - 1)] = shirt;
      sim::RobotSnapshot robot;
      robot.identity = world.robots.back();
      robot.pose.position = {-1.5 * id, 0.0};
      now.robots.push_back(robot);
    }
    world.models.resize(4);
    world.game->teams[0].players[0].goalkeeper = true;
    now.robots[3].pose.position = {4.0, 2.0};
    now.ball = {3.0, -2.0};
  }
  void put(int robot, const Point& at) {
    now.robots[static_cast<std::size_t>(robot - 1)].pose.position = at;
  }
  void play(double seconds, std::vector<sim::Event> events = {}) {
    for (int i = 0; i < static_cast<int>(seconds * rate); ++i) {
      ++world.tick;
      now.time = static_cast<double>(world.tick) / rate;
      watch.ticked(world, events);
      events.clear();
      if (world.tick % 6 == 0) watch.sample(world, now);
    }
  }
  sim::WorldState world;
  sim::Snapshot now;
  MatchWatch watch;
};

}  // namespace

class TestMatchWatch : public QObject {
  Q_OBJECT

 private slots:
  void attendedIsTimeInPlay() {
    Game game;
    game.play(4.0);
    QCOMPARE(game.watch.ballAttended(), 0.0);
    game.put(4, {3.4, -2.0});
    game.play(4.0);
    QCOMPARE(game.watch.ballAttended(), 0.5);
    game.world.game->restart.step = Restart::Step::Preparing;
    game.put(4, {0.0, 0.0});
    game.play(8.0);  // does not count
    QCOMPARE(game.watch.ballAttended(), 0.5);
    game.world.game->restart.step = Restart::Step::Free;
    game.put(4, {3.4, -2.0});
    game.world.game->teams[1].players[0].penalty = PenaltyKind::Pushing;
    game.play(8.0);  // who is penalised is not there
    QCOMPARE(game.watch.ballAttended(), 0.25);
  }

  void supportersClose() {
    Game game;
    game.now.ball = {0.0, 0.0};
    game.put(2, {0.3, 0.0});
    game.put(3, {0.5, 0.0});
    game.play(5.0);  // one of the two has the ball
    QCOMPARE(game.watch.supportersClose(), 0.0);
    // A fourth of the team beside the third.
    game.now.robots[3].identity.team = TeamColor::Blue;
    game.now.robots[3].identity.number = 4;
    game.world.robots[3] = game.now.robots[3].identity;
    game.put(4, {0.8, 0.0});
    game.play(5.0);
    QCOMPARE(game.watch.supportersClose(), 0.5);
    game.put(4, {0.5, 3.4});  // beside the field
    game.play(10.0);
    QCOMPARE(game.watch.supportersClose(), 0.25);
  }

  void whatNoRulesKnowIsCounted() {
    using S = PlayState;
    Game game;
    game.play(0.1);
    const auto change = [&](S next) {
      game.world.game->state = next;
      game.play(0.1, {{sim::EventKind::PlayStateChanged, game.world.tick, RobotId{}, int(next)}});
      return game.watch.illegalTransitions();
    };
    for (const S next : {S::Ready, S::Set, S::Playing, S::Finished, S::Initial, S::Ready}) {
      QCOMPARE(change(next), 0);
    }
    QCOMPARE(change(S::Playing), 1);  // without SET
    QCOMPARE(change(S::Finished), 1);
    QCOMPARE(change(S::Set), 2);
    game.world.game->phase = GamePhase::ShootOut;
    QCOMPARE(change(S::Finished), 2);
    QCOMPARE(change(S::Set), 2);
  }

  void removalsAreCountedByCause() {
    Game game;
    const auto remove = [&](PenaltyKind kind) {
      game.play(0.1,
                {{sim::EventKind::Penalised, game.world.tick, RobotId{2}, static_cast<int>(kind)}});
    };
    const auto comeBack = [&] {
      game.play(0.1, {{sim::EventKind::PenaltyOver, game.world.tick, RobotId{2}, 0}});
    };
    remove(PenaltyKind::Pushing);
    comeBack();
    game.play(31.0);
    remove(PenaltyKind::Pushing);
    comeBack();
    game.play(5.0);
    remove(PenaltyKind::Leaving);
    QCOMPARE(game.watch.removedAgain(), 0);
    comeBack();
    game.play(5.0);
    remove(PenaltyKind::Leaving);
    QCOMPARE(game.watch.removedAgain(), 1);
    QCOMPARE(game.watch.removalsFor(PenaltyKind::Pushing), 2);
    QCOMPARE(game.watch.removalsFor(PenaltyKind::Leaving), 2);
    game.world.game->half = 2;
    remove(PenaltyKind::Substitute);  // by hand
    QCOMPARE(game.watch.removalsOfTeamAndHalf(), 1.0);
  }
};

PITCHBOARD_TEST(TestMatchWatch)

}  // namespace tst_match_watch

#include "tst_match_watch.moc"
