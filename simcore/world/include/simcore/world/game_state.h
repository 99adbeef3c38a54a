// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The state of a refereed game: the part of WorldState that the rules own. Times are counted in
// ticks, so that runs repeat exactly and the scoreboard shows whole seconds. Plain values; any
// thread.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <base/geometry.h>
#include <simcore/world/team_color.h>

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

// Text for people and files: "PLAYING", "corner kick", "pushing".
std::string_view labelOf(PlayState state);
std::string_view labelOf(GamePhase phase);
std::string_view labelOf(SetPlay play);
std::string_view labelOf(PenaltyKind penalty);

struct GamePlayer {
  PenaltyKind penalty = PenaltyKind::None;
  bool counting = false;  ///< ticksLeft counts down
  bool outside = false;   ///< the robot has been put beside the field
  int ticksLeft = 0;      ///< of the penalty
  int sinceTicks = 0;     ///< since the penalty was called
  int warnings = 0, yellow = 0, red = 0, cautions = 0;
  bool goalkeeper = false;
  bool operator==(const GamePlayer&) const = default;
};

struct GameTeam {
  static constexpr std::size_t mostPlayers = 20;
  int number = 0;  ///< the team's number in the GameController
  TeamColor colour = TeamColor::Blue;
  int score = 0;
  int penaltyShots = 0;                         ///< shots taken in the shoot-out
  int singleShots = 0;                          ///< bit i is set if shot i scored
  int timeouts = 0;                             ///< taken in this half
  int penalties = 0;                            ///< penalties that make later ones longer
  std::array<int, 4> byHalf{};                  ///< goals; 2 and 3 are the halves of extra time
  std::array<GamePlayer, mostPlayers> players;  ///< by slot, as in the GameController's packets
  /// The shirt in each slot; 0: the slot is free. A shirt up to 20 has the slot of its number, a
  /// higher one any free slot.
  std::array<int, mostPlayers> shirts{};
  /// Returns the slot of a shirt, from 1 as in packets; 0 if it has none.
  int slotOf(int shirt) const {
    const auto found = std::find(shirts.begin(), shirts.end(), shirt);
    return shirt > 0 && found != shirts.end() ? static_cast<int>(found - shirts.begin()) + 1 : 0;
  }
  bool operator==(const GameTeam&) const = default;
};

/// What the automatic referee remembers of a robot: for how long something has lasted.
struct RobotWatch {
  int downTicks = 0;     ///< fallen
  int outsideTicks = 0;  ///< outside the field
  int contactTicks = 0;  ///< pushing an opponent
  int immuneTicks = 0;   ///< time left in which it is not judged again
  Pose setPose;          ///< pose at the start of SET; in READY, where it has stood still
  int stillTicks = 0;    ///< standing still in READY
  int areaTicks = 0;     ///< in its own goal area
  int backTicks = -1;    ///< since it returned from a penalty; -1: long ago, or never
  bool operator==(const RobotWatch&) const = default;
};

/// How the ball comes back into play: which team has it, and how far the restart has progressed.
/// The default is a ball that anybody may play.
struct Restart {
  enum class Step : std::uint8_t {
    Free,       ///< anybody may play the ball
    Placing,    ///< a set play was called; everybody stands still
    Preparing,  ///< the team that has the ball may take position
    Taking,     ///< the ball may be kicked
    Executed    ///< packets no longer show the restart, but only this team may play the ball
  };
  Step step = Step::Free;
  SetPlay kind = SetPlay::None;  ///< None: a kick-off
  int team = -1;                 ///< index of the team; below 0: no team
  Point place;                   ///< where the ball lies
  int kicker = 0;                ///< id of the robot that took it
  bool passed = true;            ///< a second player has touched the ball, or need not
  bool onlyTaker = false;        ///< no robot but the kicker has touched the ball since
  /// Returns whether packets show this set play.
  bool isAnnounced() const {
    return step == Step::Placing || step == Step::Preparing || step == Step::Taking;
  }
  bool operator==(const Restart&) const = default;
};
constexpr Restart::Step lastOf(Restart::Step) {
  return Restart::Step::Executed;
}

/// Whether the clock of the half has started.
enum class ClockUse : std::uint8_t {
  Full,      ///< not yet
  BeganNow,  ///< in the current PLAYING
  Began      ///< in an earlier PLAYING
};
constexpr ClockUse lastOf(ClockUse) {
  return ClockUse::Began;
}

/// A place that the ball has hardly left, and for how long.
struct BallRest {
  Point place;
  int ticks = 0;
  bool operator==(const BallRest&) const = default;
};

struct GameState {
  static constexpr int noTeam = -1;  ///< instead of the index of a team
  /// Time left until the state ends by itself.
  struct Countdown {
    int ticks = 0;
    bool runs = false;  ///< ticks count down
    bool operator==(const Countdown&) const = default;
  };
  /// The team that put the ball out, in leagues without set plays.
  struct DropIn {
    int team = noTeam;
    int ticks = -1;  ///< since then
    bool operator==(const DropIn&) const = default;
  };
  struct Touch {
    int robot = 0;  ///< id
    int team = noTeam;
    int ticks = 0;  ///< since then; 0: the robot touches the ball now
    bool operator==(const Touch&) const = default;
  };

  std::array<GameTeam, 2> teams;
  bool swapped = false;  ///< teams[1] defends the left goal
  PlayState state = PlayState::Initial;
  GamePhase phase = GamePhase::Normal;
  GamePhase phaseBefore = GamePhase::Normal;  ///< phase to return to after a timeout
  int half = 1;
  int firstKickOff = 0;  ///< index of the team that kicked off first
  int kickOff = 0;       ///< index of the team that kicks off; noTeam: drop ball
  Restart restart;
  bool stopped = false;
  bool over = false;  ///< after the final whistle
  int clock = 0;      ///< ticks left of the half; negative after its end
  ClockUse clockUse = ClockUse::Full;
  int stateTicks = 0;  ///< since the state or the step of the set play began
  Countdown countdown;
  int hidden = 0;     ///< ticks until robots are informed that play has begun
  int breakLeft = 0;  ///< ticks left of the break between halves
  DropIn dropIn;
  Touch touch;                      ///< the last touch of the ball
  BallRest still;                   ///< for the rule about a ball that does not move
  BallRest near;                    ///< for the rule about a ball held up among robots
  int aloneTicks = 0;               ///< since a robot was near the ball
  int shooter = noTeam;             ///< in a shoot-out: the team whose shot it is
  bool obeyed = false;              ///< only a GameController's packets change the game
  std::vector<RobotWatch> watches;  ///< in the order of the robots

  /// Called when PLAYING begins.
  void beginClock() {
    clockUse = clockUse == ClockUse::Full ? ClockUse::BeganNow : ClockUse::Began;
  }
  // The set play that packets show, and the team that takes it.
  SetPlay setPlay() const { return restart.isAnnounced() ? restart.kind : SetPlay::None; }
  int setPlayTeam() const { return restart.isAnnounced() ? restart.team : noTeam; }
  bool ballFree() const { return restart.step == Restart::Step::Free; }
  /// Returns the index of the current half in GameTeam::byHalf; empty in a shoot-out.
  std::optional<std::size_t> period() const {
    const GamePhase now = phase == GamePhase::Timeout ? phaseBefore : phase;
    if (now == GamePhase::ShootOut) return {};
    return static_cast<std::size_t>((now == GamePhase::ExtraTime ? 2 : 0) + half - 1);
  }
  /// Returns the index of the team that defends the left goal.
  std::size_t leftTeam() const { return swapped ? 1 : 0; }
  /// Returns the index of the team of this colour, or noTeam.
  int teamOf(TeamColor colour) const {
    for (std::size_t i = 0; i < teams.size(); ++i) {
      if (teams[i].colour == colour) return static_cast<int>(i);
    }
    return noTeam;
  }
  /// Returns the player of this colour and shirt; null if it plays in neither team.
  const GamePlayer* player(TeamColor colour, int shirt) const {
    const int team = teamOf(colour);
    const int slot = team < 0 ? 0 : teams[static_cast<std::size_t>(team)].slotOf(shirt);
    return slot == 0
               ? nullptr
               : &teams[static_cast<std::size_t>(team)].players[static_cast<std::size_t>(slot - 1)];
  }
  /// Returns whether the team attacks towards +x.
  bool attacksRight(std::size_t team) const { return team == leftTeam(); }
  bool operator==(const GameState&) const = default;
};

// The functions below visit the values of a game as state_values.h describes.

template <class Game, class Visitor>
void visitTeams(Game& g, Visitor& v) {
  const auto all = [&v](auto&... values) { (v.value(values), ...); };
  for (auto& t : g.teams) {
    all(t.number, t.colour, t.score, t.penaltyShots, t.singleShots, t.timeouts, t.penalties);
    for (auto& p : t.players) {
      all(p.penalty, p.counting, p.outside, p.ticksLeft, p.sinceTicks, p.warnings, p.yellow, p.red,
          p.cautions, p.goalkeeper);
    }
  }
}

template <class Game, class Visitor>
void visitWatches(Game& g, Visitor& v) {
  v.count(g.watches);
  for (auto& w : g.watches) {
    for (auto* value : {&w.downTicks, &w.outsideTicks, &w.contactTicks, &w.immuneTicks}) {
      v.value(*value);
    }
    for (auto* value : {&w.setPose.position.x, &w.setPose.position.y, &w.setPose.yaw}) {
      v.value(*value);
    }
  }
}

/// Visits what a game had up to version 5 of saved states.
template <class Game, class Visitor>
void visitGameOfForm5(Game& g, Visitor& v) {
  const auto all = [&v](auto&... values) { (v.value(values), ...); };
  visitTeams(g, v);
  for (auto& t : g.teams) {
    for (auto& shirt : t.shirts) v.value(shirt);
  }
  all(g.swapped, g.state, g.phase, g.phaseBefore, g.half, g.firstKickOff, g.kickOff, g.restart.step,
      g.restart.kind, g.restart.team, g.restart.place.x, g.restart.place.y, g.restart.kicker,
      g.restart.passed, g.stopped, g.over, g.clock, g.clockUse, g.stateTicks, g.countdown.ticks,
      g.countdown.runs, g.hidden, g.breakLeft, g.dropIn.team, g.dropIn.ticks, g.touch.robot,
      g.touch.team, g.still.place.x, g.still.place.y, g.still.ticks, g.near.place.x, g.near.place.y,
      g.near.ticks, g.aloneTicks, g.shooter);
  visitWatches(g, v);
}

/// Visits everything.
template <class Game, class Visitor>
void visitGame(Game& g, Visitor& v) {
  visitGameOfForm5(g, v);
  const auto all = [&v](auto&... values) { (v.value(values), ...); };
  for (auto& t : g.teams) {
    for (auto& goals : t.byHalf) v.value(goals);
  }
  for (auto& w : g.watches) all(w.stillTicks, w.areaTicks, w.backTicks);
  all(g.restart.onlyTaker, g.touch.ticks, g.obeyed);
}

}  // namespace pitchboard::sim
