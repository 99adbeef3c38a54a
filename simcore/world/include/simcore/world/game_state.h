// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The game as the referee has it: the part of WorldState that the rules own. Times are ticks, so
// that they repeat to the bit and seconds on the scoreboard come out whole. Plain values.

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
  int singleShots = 0;                          ///< a bit for each shot that scored
  int timeouts = 0;                             ///< taken in this half
  int penalties = 0;                            ///< escalating ones so far
  std::array<int, 4> byHalf{};                  ///< goals; 2 and 3 are the halves of extra time
  std::array<GamePlayer, mostPlayers> players;  ///< by slot, as packets have them
  /// Who has which slot: that of its number, or above 20 a free one; 0: nobody.
  std::array<int, mostPlayers> shirts{};
  /// From 1, as in packets; 0 when this shirt has none (yet).
  int slotOf(int shirt) const {
    const auto found = std::find(shirts.begin(), shirts.end(), shirt);
    return shirt > 0 && found != shirts.end() ? static_cast<int>(found - shirts.begin()) + 1 : 0;
  }
  bool operator==(const GameTeam&) const = default;
};

/// What the automatic referee remembers of one robot.
struct RobotWatch {
  int downTicks = 0;
  int outsideTicks = 0;
  int contactTicks = 0;
  int immuneTicks = 0;
  Pose setPose;        ///< when SET began; in READY, where it has stood for `stillTicks`
  int stillTicks = 0;  ///< in READY
  int areaTicks = 0;   ///< in its own goal area
  int backTicks = -1;  ///< since it came back from a penalty; -1: long ago, or never
  bool operator==(const RobotWatch&) const = default;
};

/// How the ball came, or comes, back into play: whose it is, and how far that has gone. As it is by
/// default, it is nobody's.
struct Restart {
  /// Free: anybody may play the ball. Of a set play that robots are told of: Placing, everybody
  /// stands; Preparing, who has the ball may take its place; Taking, it may be kicked. Executed:
  /// the ball of a kick-off, a shot, or a set play that is not told of any more is the side's
  /// alone.
  enum class Step : std::uint8_t { Free, Placing, Preparing, Taking, Executed };
  Step step = Step::Free;
  SetPlay kind = SetPlay::None;  ///< none: a kick-off
  int team = -1;                 ///< index; below 0: nobody's
  Point place;                   ///< where the ball lies for it
  int kicker = 0;                ///< robot that took it
  bool passed = true;            ///< a second player has touched it since, or it needs none
  bool onlyTaker = false;        ///< who took it is still the only one that has touched it
  bool isTold() const {
    return step == Step::Placing || step == Step::Preparing || step == Step::Taking;
  }
  bool operator==(const Restart&) const = default;
};
constexpr Restart::Step lastOf(Restart::Step) {
  return Restart::Step::Executed;
}

/// Whether the clock of the half has been used.
enum class ClockUse : std::uint8_t {
  Full,
  BeganNow,  ///< with this PLAYING
  Began
};
constexpr ClockUse lastOf(ClockUse) {
  return ClockUse::Began;
}

/// A place that the ball has hardly left.
struct BallRest {
  Point place;
  int ticks = 0;
  bool operator==(const BallRest&) const = default;
};

struct GameState {
  static constexpr int nobody = -1;
  /// What the state waits for: ticks left, and whether they go by.
  struct Countdown {
    int ticks = 0;
    bool runs = false;
    bool operator==(const Countdown&) const = default;
  };
  /// Who put the ball out, and how long ago (leagues without set plays).
  struct DropIn {
    int team = nobody;
    int ticks = -1;
    bool operator==(const DropIn&) const = default;
  };
  struct Touch {
    int robot = 0;
    int team = nobody;
    int ticks = 0;  ///< since then; 0: it touches the ball now
    bool operator==(const Touch&) const = default;
  };

  std::array<GameTeam, 2> teams;
  bool swapped = false;  ///< teams[1] defends the left goal
  PlayState state = PlayState::Initial;
  GamePhase phase = GamePhase::Normal;
  GamePhase phaseBefore = GamePhase::Normal;  ///< a timeout
  int half = 1;
  int firstKickOff = 0;  ///< index of the team that began the game
  int kickOff = 0;       ///< index, or nobody: drop ball
  Restart restart;
  bool stopped = false;
  bool over = false;  ///< the final whistle
  int clock = 0;      ///< ticks left of the half, negative after its end
  ClockUse clockUse = ClockUse::Full;
  int stateTicks = 0;  ///< since the state, or the step of the set play, began
  Countdown countdown;
  int hidden = 0;  ///< ticks for which PLAYING is not told yet
  int breakLeft = 0;
  DropIn dropIn;
  Touch touch;           ///< the last one
  BallRest still, near;  ///< near: for a heap of robots
  int aloneTicks = 0;
  int shooter = nobody;             ///< team of the shot, in a shoot-out
  bool obeyed = false;              ///< it is a GameController's, which alone changes it
  std::vector<RobotWatch> watches;  ///< in the order of the robots

  /// At the beginning of PLAYING.
  void beginClock() {
    clockUse = clockUse == ClockUse::Full ? ClockUse::BeganNow : ClockUse::Began;
  }
  /// The set play that robots are told of, and whose it is.
  SetPlay setPlay() const { return restart.isTold() ? restart.kind : SetPlay::None; }
  int setPlayTeam() const { return restart.isTold() ? restart.team : nobody; }
  bool ballFree() const { return restart.step == Restart::Step::Free; }
  /// Index of GameTeam::byHalf; nothing in a shoot-out.
  std::optional<std::size_t> period() const {
    const GamePhase now = phase == GamePhase::Timeout ? phaseBefore : phase;
    if (now == GamePhase::ShootOut) return {};
    return static_cast<std::size_t>((now == GamePhase::ExtraTime ? 2 : 0) + half - 1);
  }
  /// Index of the team that defends this side.
  std::size_t leftTeam() const { return swapped ? 1 : 0; }
  /// Index of the team of this colour, or nobody.
  int teamOf(TeamColor colour) const {
    for (std::size_t i = 0; i < teams.size(); ++i) {
      if (teams[i].colour == colour) return static_cast<int>(i);
    }
    return nobody;
  }
  /// The player of this colour and shirt; null when it plays in neither team.
  const GamePlayer* player(TeamColor colour, int shirt) const {
    const int team = teamOf(colour);
    const int slot = team < 0 ? 0 : teams[static_cast<std::size_t>(team)].slotOf(shirt);
    return slot == 0
               ? nullptr
               : &teams[static_cast<std::size_t>(team)].players[static_cast<std::size_t>(slot - 1)];
  }
  /// Attacks towards +x.
  bool attacksRight(std::size_t team) const { return team == leftTeam(); }
  bool operator==(const GameState&) const = default;
};

/// The teams' scores and penalties.
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

/// All that a game had until form 5 of saved states.
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
