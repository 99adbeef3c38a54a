// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A referee's rule set as data: times, thresholds, and which rules are judged at all. The built-in
// sets are resources/rules/*.json (docs/referee.md); a scenario names one and may change every
// number. Times are seconds of simulated time, lengths metres. Each number is described in
// referee_parameters.h, which also makes the tables of docs/referee.md. Plain values; any thread.

#include <cstdint>
#include <string>

#include <base/game.h>

namespace pitchboard::sim {

/// The league and year whose GameController the state machine follows (docs/referee.md).
enum class RefereeStyle : std::uint8_t {
  Humanoid2014,       ///< a ball that is out is put back and play continues; no set plays
  Humanoid2021,       ///< set plays stop the clock and go through freeze, prepare, ready, execute
  HumanoidSoccer2026  ///< the clock runs during set plays; packets announce PLAYING with a delay
};
constexpr RefereeStyle lastOf(RefereeStyle) {
  return RefereeStyle::HumanoidSoccer2026;
}

constexpr League leagueOf(RefereeStyle style) {
  return style == RefereeStyle::HumanoidSoccer2026 ? League::HumanoidSoccer : League::Humanoid;
}

/// What a style implies and no rule can change.
struct RefereeConduct {
  bool replacesBall;         ///< a ball that is out is put back and is in play at once
  bool preparesSetPlays;     ///< set plays have the steps placing, preparing and taking
  bool goalKickAtArea;       ///< goal kicks are taken at the front corner of the goal area
  bool countsBelowZero;      ///< the countdown of the break continues below zero
  bool penaltiesCountInSet;  ///< the times of penalties count down in SET
  bool waitsAtHalfway;       ///< removed robots return near the halfway line
  int suddenDeathShots;      ///< of each team; then a coin decides. 0: until one is ahead
};
constexpr RefereeConduct conductOf(RefereeStyle style) {
  constexpr RefereeConduct all[] = {{true, true, false, false, true, true, 0},
                                    {false, true, false, false, true, false, 0},
                                    {false, false, true, true, false, false, 3}};
  return all[static_cast<std::size_t>(style)];
}

struct RefereeRules {
  std::string name = "custom";
  RefereeStyle style = RefereeStyle::Humanoid2021;
  int packetVersion = 12;  ///< version of the GameController's packets
  int packetSize = 688;    ///< bytes; tells apart the two layouts of version 12

  // Times of the states.
  double halfTime = 600;
  double extraHalfTime = 300;
  double breakTime = 300;
  double beforeMatch = 10;  ///< in INITIAL, before the first READY
  double beforeHalf = 15;   ///< shortest time from FINISHED to the next READY
  double readyTime = 45;
  double setTime = 5;
  double shotSetTime = 15;
  double kickOffTime = 10;   ///< during this time only the kicking team may play the ball
  double playingHidden = 0;  ///< delay with which packets announce PLAYING
  double shotTime = 60;
  int shots = 5;
  double timeoutTime = 120;
  double refereeTimeoutTime = 600;
  double readyStillTime = 0;  ///< READY ends once all robots have stood in position for this time

  // Set plays.
  double placingTime = 5;
  double prepareTime = 30;
  double readyStepTime = 1;
  double takeTime = 10;
  double penaltyKickReady = 0;  ///< READY before a penalty kick; 0: as in other set plays
  double penaltyKickTime = 60;
  double distanceToBall = 0.75;

  // Penalties.
  double removalTime = 30;
  double removalMore = 0;  ///< added for each earlier escalating penalty of the team
  double motionTime = 15;
  double shotKeeperTime = 120;
  double placedAfter = 3;  ///< time that an assistant needs to put the robot outside

  // What the automatic referee judges; 0 disables a time or limit.
  double fallenTime = 20;
  double leavingTime = 20;
  double stillTime = 30;  ///< drop ball after the ball has not moved for this time
  double stillDistance = 0.05;
  double nobodyTime = 30;     ///< drop ball after nobody was within 1 m of the ball for this time
  double localStuckTime = 0;  ///< the nearest robot is penalised if the ball moved less than 0.1 m
  double localStuckReach = 0.5;
  double pushingTime = 1;
  double motionInSet = 0;  ///< distance that a robot may move in SET
  double inPlayDistance = 0.05;
  int mercy = 0;         ///< goal difference that ends the match
  int goalAreaMost = 0;  ///< robots of a team that may be in its own goal area

  // Rules that are judged.
  bool goals = true;
  bool throwIns = true;
  bool goalKicks = true;
  bool cornerKicks = true;
  bool freeKicks = true;
  bool dropBalls = true;
  bool kickOffPositions = true;
  bool exclusiveBall = true;  ///< after a restart, opponents may not touch the ball too early
  bool directGoals = true;    ///< a goal from a kick-off or throw-in needs a second player
  bool doubleTouch = false;   ///< who took a set play may not touch the ball twice in a row
  bool changeSides = true;
  bool clockStopsInSetPlays = true;
  bool escalates = false;
  bool countsFromCall = false;    ///< penalties count from the call, not from leaving the field
  bool countsAlways = false;      ///< penalties count in every state
  bool pardonsAtPlay = false;     ///< all penalties end at a kick-off
  bool halfEndsWithBall = false;  ///< a half ends only when the ball is at rest, or 10 s later
  bool knockout = false;          ///< a tie is decided by extra time and penalty shoot-out
  bool extraTime = true;
  bool automatic = true;  ///< false: only a person or a program makes calls

  bool operator==(const RefereeRules&) const = default;
};

/// Passes what rules had up to version 5 of saved states to `all`.
template <class Rules, class Visitor>
void visitRefereeRulesOfForm5(Rules& r, Visitor&& all) {
  all(r.name, r.style, r.packetVersion, r.packetSize, r.halfTime, r.extraHalfTime, r.breakTime,
      r.beforeMatch, r.beforeHalf, r.readyTime, r.setTime, r.shotSetTime, r.kickOffTime,
      r.playingHidden, r.shotTime, r.shots, r.timeoutTime, r.placingTime, r.prepareTime,
      r.readyStepTime, r.takeTime, r.penaltyKickReady, r.penaltyKickTime, r.distanceToBall,
      r.removalTime, r.removalMore, r.motionTime, r.shotKeeperTime, r.placedAfter, r.fallenTime,
      r.leavingTime, r.stillTime, r.stillDistance, r.nobodyTime, r.localStuckTime, r.pushingTime,
      r.motionInSet, r.inPlayDistance, r.mercy, r.goals, r.throwIns, r.goalKicks, r.cornerKicks,
      r.freeKicks, r.dropBalls, r.kickOffPositions, r.exclusiveBall, r.directGoals, r.changeSides,
      r.clockStopsInSetPlays, r.escalates, r.countsFromCall, r.countsAlways, r.pardonsAtPlay,
      r.halfEndsWithBall, r.knockout, r.extraTime, r.automatic);
}

/// Passes all values to `all`, in one call for each group; hash and saved states use it.
template <class Rules, class Visitor>
void visitRefereeRules(Rules& r, Visitor&& all) {
  visitRefereeRulesOfForm5(r, all);
  all(r.refereeTimeoutTime, r.readyStillTime, r.localStuckReach, r.goalAreaMost, r.doubleTouch);
}

}  // namespace pitchboard::sim
