// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The game as the referee has it: the part of WorldState that the rules own. Times are ticks, so
// that they repeat to the bit and seconds on the scoreboard come out whole. Plain values.

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include <base/geometry.h>
#include <base/ids.h>

namespace pitchboard::sim {

enum class PlayState : std::uint8_t { Initial, Ready, Set, Playing, Finished };
constexpr PlayState lastOf(PlayState) {
  return PlayState::Finished;
}
enum class GamePhase : std::uint8_t { Normal, ShootOut, ExtraTime, Timeout };
constexpr GamePhase lastOf(GamePhase) {
  return GamePhase::Timeout;
}
enum class SetPlay : std::uint8_t {
  None,
  DirectFreeKick,
  IndirectFreeKick,
  PenaltyKick,
  ThrowIn,
  GoalKick,
  CornerKick
};
constexpr SetPlay lastOf(SetPlay) {
  return SetPlay::CornerKick;
}
/// Placing: everybody stands. Preparing: who has the ball may take its place. Taking: it may be
/// kicked.
enum class SetPlayStep : std::uint8_t { None, Placing, Preparing, Taking };
constexpr SetPlayStep lastOf(SetPlayStep) {
  return SetPlayStep::Taking;
}
enum class PenaltyKind : std::uint8_t {
  None,
  BallManipulation,
  Pushing,
  IllegalAttack,
  IllegalDefence,
  Incapable,
  Service,
  IllegalPosition,
  MotionInSet,
  MotionInStop,
  LocalStuck,
  Holding,
  Leaving,
  Hands,
  Cautioned,
  SentOff,
  Substitute,
  Manual
};
constexpr PenaltyKind lastOf(PenaltyKind) {
  return PenaltyKind::Manual;
}

// In words, for people and files: "PLAYING", "corner kick", "pushing".
std::string_view wordsOf(PlayState state);
std::string_view wordsOf(GamePhase phase);
std::string_view wordsOf(SetPlay play);
std::string_view wordsOf(PenaltyKind penalty);

struct GamePlayer {
  PenaltyKind penalty = PenaltyKind::None;
  bool counting = false;
  bool outside = false;  ///< has been put beside the field
  int ticksLeft = 0;
  int sinceTicks = 0;
  int warnings = 0, yellow = 0, red = 0, cautions = 0;
  bool goalkeeper = false;
  bool operator==(const GamePlayer&) const = default;
};

struct GameTeam {
  static constexpr std::size_t mostPlayers = 20;
  int number = 0;  ///< in the GameController
  TeamColor colour = TeamColor::Blue;
  int score = 0;
  int penaltyShots = 0;
  int singleShots = 0;  ///< a bit for each shot that scored
  int timeouts = 0;     ///< taken in this half
  int penalties = 0;    ///< escalating ones so far
  std::array<GamePlayer, mostPlayers> players;  ///< by shirt, from 1
  bool operator==(const GameTeam&) const = default;
};

/// What the automatic referee remembers of one robot.
struct RobotWatch {
  int downTicks = 0;
  int outsideTicks = 0;
  int contactTicks = 0;
  int immuneTicks = 0;
  Pose setPose;  ///< when SET began
  bool operator==(const RobotWatch&) const = default;
};

struct GameState {
  static constexpr int nobody = -1;

  std::array<GameTeam, 2> teams;
  bool swapped = false;  ///< teams[1] defends the left goal
  PlayState state = PlayState::Initial;
  GamePhase phase = GamePhase::Normal;
  GamePhase phaseBefore = GamePhase::Normal;  ///< a timeout
  int half = 1;
  int firstKickOff = 0;  ///< index of the team that began the game
  int kickOff = 0;       ///< index, or nobody: drop ball
  bool kickOffStands = true;  ///< false: the kick-off is over, for leagues that say so
  SetPlay setPlay = SetPlay::None;
  SetPlayStep step = SetPlayStep::None;
  int setPlayTeam = nobody;
  bool stopped = false;
  bool over = false;  ///< the final whistle
  int clock = 0;      ///< ticks left of the half, negative after its end
  bool clockBegan = false;        ///< the half has seen PLAYING
  bool clockBeganBefore = false;  ///< before this PLAYING
  bool clockShown = true;
  int stateTicks = 0;  ///< since the state began
  int secondary = 0;   ///< ticks left of what the state waits for
  bool secondaryRuns = false;
  int hidden = 0;       ///< ticks for which PLAYING is not told yet
  int dropInTeam = nobody;
  int dropInTicks = -1;
  int breakLeft = 0;

  bool ballFree = true;  ///< nobody has it alone
  Point restart;         ///< where the ball lies for a restart
  int restartTeam = nobody;
  SetPlay restartKind = SetPlay::None;
  int kicker = 0;           ///< robot that took the restart
  bool passed = true;       ///< a second player has touched it since, or it needs none
  int lastTouch = 0;        ///< robot
  int lastTouchTeam = nobody;
  Point still;              ///< where the ball has been lying
  int stillTicks = 0;
  Point near;               ///< the same, for a heap of robots
  int nearTicks = 0;
  int aloneTicks = 0;
  int shooter = nobody;     ///< team of the shot, in a shoot-out
  int shotsBegan = 0;
  std::vector<RobotWatch> watches;  ///< in the order of the robots

  /// Index of the team that defends this side.
  std::size_t leftTeam() const { return swapped ? 1 : 0; }
  /// Index of the team of this colour, or nobody.
  int teamOf(TeamColor colour) const {
    for (std::size_t i = 0; i < teams.size(); ++i) {
      if (teams[i].colour == colour) return static_cast<int>(i);
    }
    return nobody;
  }
  /// Attacks towards +x.
  bool attacksRight(std::size_t team) const { return team == leftTeam(); }
  bool operator==(const GameState&) const = default;
};

template <class Game, class Visitor>
void visitGame(Game& g, Visitor& v) {
  const auto all = [&v](auto&... values) { (v.value(values), ...); };
  for (auto& t : g.teams) {
    all(t.number, t.colour, t.score, t.penaltyShots, t.singleShots, t.timeouts, t.penalties);
    for (auto& p : t.players) {
      all(p.penalty, p.counting, p.outside, p.ticksLeft, p.sinceTicks, p.warnings, p.yellow, p.red,
          p.cautions, p.goalkeeper);
    }
  }
  all(g.swapped, g.state, g.phase, g.phaseBefore, g.half, g.firstKickOff, g.kickOff,
      g.kickOffStands, g.setPlay, g.step, g.setPlayTeam, g.stopped, g.over, g.clock, g.clockBegan,
      g.clockBeganBefore, g.clockShown, g.stateTicks, g.secondary, g.secondaryRuns, g.hidden,
      g.dropInTeam, g.dropInTicks, g.breakLeft, g.ballFree, g.restart.x, g.restart.y, g.restartTeam,
      g.restartKind, g.kicker, g.passed, g.lastTouch, g.lastTouchTeam, g.still.x, g.still.y,
      g.stillTicks, g.near.x, g.near.y, g.nearTicks, g.aloneTicks, g.shooter, g.shotsBegan);
  v.count(g.watches);
  for (auto& w : g.watches) {
    all(w.downTicks, w.outsideTicks, w.contactTicks, w.immuneTicks, w.setPose.position.x,
        w.setPose.position.y, w.setPose.yaw);
  }
}

}  // namespace pitchboard::sim
