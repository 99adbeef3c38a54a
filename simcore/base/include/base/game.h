// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The game that a referee leads: one value for the packets of every league, the simulated referee,
// files and saved moments. Readers at the edge make it (gameOf() in telemetry/referee from packets,
// simcore/rules from calls, robotlink/session from columns), writers at the edge turn it into
// packets, columns and words. Times are counted in ticks: those of a simulated match, so that runs
// repeat exactly, and whole seconds in packets. Plain values; any thread.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <base/geometry.h>
#include <base/team_color.h>

namespace pitchboard {

/// Whose rules a game follows; it decides what the codes of packets mean.
enum class League : std::uint8_t {
  Humanoid,          ///< HL: packets v7, v8, v9, v11 (592 bytes), v12 (640 and 688)
  StandardPlatform,  ///< SPL: v10, v11 (58), v12 (54) ... v18
  HumanoidSoccer     ///< HSL since 2026: v19, v20
};

// lastOf() is the last value that a simulated game can have, and files know. What follows it is
// said by packets only.

enum class PlayState : std::uint8_t { Initial, Ready, Set, Playing, Finished, Standby, Unknown };
constexpr PlayState lastOf(PlayState) {
  return PlayState::Finished;
}
enum class GamePhase : std::uint8_t { Normal, ShootOut, ExtraTime, Timeout, Unknown };
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
  CornerKick,
  PushingFreeKick,
  KickIn,
  Unknown
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
  Manual,
  PickUp,
  PickUpToService,
  IncapableRobot,
  BallContact,
  Inactive,
  IllegalDefender,
  KickOffGoal,
  CoachMotion,
  IllegalPositionInSet,
  Stance,
  MotionInInitial,
  Unknown
};
constexpr PenaltyKind lastOf(PenaltyKind) {
  return PenaltyKind::Manual;
}
/// What a countdown leads to.
enum class CountdownTo : std::uint8_t { Nothing, Set, BallFree, Ready, NextHalf, TimeoutOver };

/// What a simulated game calls it; values that a simulated game has stay as they are.
SetPlay simulated(SetPlay play);
PenaltyKind simulated(PenaltyKind penalty);

// Text for people and files: "PLAYING", "corner kick", "pushing", "ball free".
std::string_view labelOf(PlayState state);
std::string_view labelOf(GamePhase phase);
std::string_view labelOf(SetPlay play);
std::string_view labelOf(PenaltyKind penalty);
std::string_view labelOf(CountdownTo countdown);

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
  static constexpr std::size_t maxPlayers = 20;
  int number = 0;  ///< the team's number in the GameController
  TeamColor colour = TeamColor::Blue;
  int score = 0;
  int penaltyShots = 0;                        ///< shots taken in the shoot-out
  int singleShots = 0;                         ///< bit i is set if shot i scored
  int timeouts = 0;                            ///< taken in this half
  int penalties = 0;                           ///< penalties that make later ones longer
  std::optional<int> messageBudget{};          ///< messages that it may still send; empty: no limit
  std::array<int, 4> byHalf{};                 ///< goals; 2 and 3 are the halves of extra time
  std::array<GamePlayer, maxPlayers> players;  ///< by slot, as in the GameController's packets
  /// The shirt in each slot; 0: the slot is free. A shirt up to 20 has the slot of its number, a
  /// higher one any free slot.
  std::array<int, maxPlayers> shirts{};
  /// Returns the slot of a shirt, from 1 as in packets; 0 if it has none.
  int slotOf(int shirt) const {
    const auto found = std::find(shirts.begin(), shirts.end(), shirt);
    return shirt > 0 && found != shirts.end() ? static_cast<int>(found - shirts.begin()) + 1 : 0;
  }
  /// Returns the shirts in the order of the slots, without substitutes that wait.
  std::vector<int> onField() const {
    std::vector<int> out;
    for (std::size_t i = 0; i < maxPlayers; ++i) {
      if (shirts[i] != 0 && players[i].penalty != PenaltyKind::Substitute) out.push_back(shirts[i]);
    }
    return out;
  }
  /// Returns how many players may play now.
  int playing() const {
    int count = 0;
    for (std::size_t i = 0; i < maxPlayers; ++i) {
      count += shirts[i] != 0 && players[i].penalty == PenaltyKind::None ? 1 : 0;
    }
    return count;
  }
  /// Returns the player with this shirt; null if it has none.
  const GamePlayer* player(int shirt) const {
    const int slot = slotOf(shirt);
    return slot == 0 ? nullptr : &players[static_cast<std::size_t>(slot - 1)];
  }
  bool operator==(const GameTeam&) const = default;
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
/// "stop", "prepare", "ready"; empty for a restart that is not announced.
std::string_view labelOf(Restart::Step step);

/// Whether the clock of the half has started.
enum class ClockUse : std::uint8_t {
  Full,      ///< not yet
  BeganNow,  ///< in the current PLAYING
  Began      ///< in an earlier PLAYING
};
constexpr ClockUse lastOf(ClockUse) {
  return ClockUse::Began;
}

struct Game {
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

  League league = League::Humanoid;
  double tickRate = 1.0;  ///< ticks in a second
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
  int shooter = noTeam;  ///< in a shoot-out: the team whose shot it is

  /// Called when PLAYING begins.
  void beginClock() {
    clockUse = clockUse == ClockUse::Full ? ClockUse::BeganNow : ClockUse::Began;
  }
  // The set play that packets show, and the team that takes it.
  SetPlay setPlay() const { return restart.isAnnounced() ? restart.kind : SetPlay::None; }
  int setPlayTeam() const { return restart.isAnnounced() ? restart.team : noTeam; }
  bool ballFree() const { return restart.step == Restart::Step::Free; }
  /// Returns whole seconds, rounded up as on a scoreboard.
  int seconds(int ticks) const {
    return static_cast<int>(std::ceil(static_cast<double>(ticks) / tickRate - 1e-9));
  }
  int secondsLeft() const { return seconds(clock); }
  /// Returns the seconds until what countdownTo() says; 0 if nothing is counted down.
  int countdownSeconds() const {
    return state == PlayState::Playing && ballFree() ? 0 : seconds(countdown.ticks);
  }
  CountdownTo countdownTo() const {
    if (countdownSeconds() == 0) return CountdownTo::Nothing;
    if (phase == GamePhase::Timeout) return CountdownTo::TimeoutOver;
    if (state == PlayState::Ready) return CountdownTo::Set;
    if (state == PlayState::Initial || state == PlayState::Finished) return CountdownTo::NextHalf;
    if (restart.step == Restart::Step::Preparing) return CountdownTo::Ready;
    const bool waits = restart.isAnnounced() || state == PlayState::Playing;
    return waits ? CountdownTo::BallFree : CountdownTo::Nothing;
  }
  /// Returns the seconds left of a penalty, as packets of the league have them.
  int penaltySeconds(const GamePlayer& player) const {
    const bool waits = league == League::HumanoidSoccer && !player.counting;
    return waits ? 0 : std::max(0, seconds(player.ticksLeft));
  }
  /// Returns the index of the current half in GameTeam::byHalf; empty in a shoot-out.
  std::optional<std::size_t> period() const {
    const GamePhase now = phase == GamePhase::Timeout ? phaseBefore : phase;
    if (now == GamePhase::ShootOut) return {};
    return static_cast<std::size_t>((now == GamePhase::ExtraTime ? 2 : 0) + half - 1);
  }
  /// Returns the index of the team that defends the left goal.
  std::size_t leftTeam() const { return swapped ? 1 : 0; }
  /// Returns the team that defends the left goal, or the right one.
  const GameTeam& teamAt(bool right) const { return teams[right ? 1 - leftTeam() : leftTeam()]; }
  /// Returns the index of the team with this number, or noTeam.
  int teamNumbered(std::optional<int> number) const {
    for (std::size_t i = 0; number && i < teams.size(); ++i) {
      if (teams[i].number == *number) return static_cast<int>(i);
    }
    return noTeam;
  }
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
    return team < 0 ? nullptr : teams[static_cast<std::size_t>(team)].player(shirt);
  }
  /// Returns whether the team attacks towards +x.
  bool attacksRight(std::size_t team) const { return team == leftTeam(); }
  bool operator==(const Game&) const = default;
};

}  // namespace pitchboard
