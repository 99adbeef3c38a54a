// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A referee's rule set as data: times, thresholds, and which rules are judged at all. The built-in
// sets are resources/rules/*.json (docs/referee.md); a scenario names one and may change every
// number. Times in seconds of simulated time, lengths in metres; 0 switches a time off where its
// meaning says so. Plain values.

#include <cstdint>
#include <string>

namespace pitchboard::sim {

/// Which controllers' conduct the machine of states follows (docs/referee.md).
enum class RefereeStyle : std::uint8_t {
  Humanoid2014,       ///< the ball is replaced and play goes on: no set plays in the packets
  Humanoid2021,       ///< set plays stop the clock: freeze, prepare, ready, execute
  HumanoidSoccer2026  ///< set plays while the clock runs; PLAYING is told late
};
constexpr RefereeStyle lastOf(RefereeStyle) {
  return RefereeStyle::HumanoidSoccer2026;
}

/// What a style means, where that is no rule of its own.
struct RefereeConduct {
  bool replacesBall;         ///< a ball that is out is put back, in play at once
  bool preparesSetPlays;     ///< placing, preparing, taking; else stopped, then taken at once
  bool goalKickAtArea;       ///< from its front corner; else from the halfway line
  bool countsBelowZero;      ///< the break's countdown
  bool penaltiesCountInSet;  ///< their times
  bool waitsAtHalfway;       ///< who is removed comes back near the halfway line
};
constexpr RefereeConduct conductOf(RefereeStyle style) {
  constexpr RefereeConduct all[] = {{true, true, false, false, true, true},
                                    {false, true, false, false, true, false},
                                    {false, false, true, true, false, false}};
  return all[static_cast<std::size_t>(style)];
}

struct RefereeRules {
  std::string name = "custom";
  RefereeStyle style = RefereeStyle::Humanoid2021;
  int packetVersion = 12;  ///< of the GameController's packets
  int packetSize = 688;    ///< bytes; version 12 has two

  // The states' times.
  double halfTime = 600;
  double extraHalfTime = 300;
  double breakTime = 300;
  double beforeMatch = 10;  ///< INITIAL before the first READY
  double beforeHalf = 15;   ///< at least, from FINISHED to the next READY
  double readyTime = 45;
  double setTime = 5;
  double shotSetTime = 15;
  double kickOffTime = 10;  ///< the ball is the kicking side's alone
  double playingHidden = 0;
  double shotTime = 60;
  int shots = 5;
  double timeoutTime = 120;
  double refereeTimeoutTime = 600;
  double readyStillTime = 0;  ///< READY ends when all have stood in position for so long

  // Set plays.
  double placingTime = 5;
  double prepareTime = 30;
  double readyStepTime = 1;
  double takeTime = 10;
  double penaltyKickReady = 0;  ///< 0: a set play like the others
  double penaltyKickTime = 60;
  double distanceToBall = 0.75;

  // Penalties.
  double removalTime = 30;
  double removalMore = 0;  ///< for each earlier escalating penalty of the team
  double motionTime = 15;
  double shotKeeperTime = 120;
  double placedAfter = 3;  ///< until an assistant has put the robot outside

  // What the automatic referee judges; 0 switches a time or a limit off.
  double fallenTime = 20;
  double leavingTime = 20;
  double stillTime = 30;  ///< the ball, then drop ball
  double stillDistance = 0.05;
  double nobodyTime = 30;     ///< nobody within a metre of the ball, then drop ball
  double localStuckTime = 0;  ///< the ball within 0.1 m, then the nearest robot is penalised
  double localStuckReach = 0.5;
  double pushingTime = 1;
  double motionInSet = 0;  ///< m
  double inPlayDistance = 0.05;
  int mercy = 0;         ///< goals' difference that ends the match
  int goalAreaMost = 0;  ///< of a team's robots in its own goal area

  // Rules that are judged.
  bool goals = true;
  bool throwIns = true;
  bool goalKicks = true;
  bool cornerKicks = true;
  bool freeKicks = true;
  bool dropBalls = true;
  bool kickOffPositions = true;
  bool exclusiveBall = true;  ///< restarts: the other side touches the ball too early
  bool directGoals = true;    ///< a goal needs a second player after a kick-off or throw-in
  bool doubleTouch = false;   ///< who takes a set play may not touch the ball again at once
  bool changeSides = true;
  bool clockStopsInSetPlays = true;
  bool escalates = false;
  bool countsFromCall = false;    ///< penalties count at once, not when the robot is outside
  bool countsAlways = false;      ///< penalties count in every state
  bool pardonsAtPlay = false;     ///< a kick-off frees everybody
  bool halfEndsWithBall = false;  ///< only when the ball lies still, or 10 s later
  bool knockout = false;          ///< a tie goes on: extra time, penalty shoot-out
  bool extraTime = true;
  bool automatic = true;  ///< the referee calls by itself; false: a person, or a program, does

  bool operator==(const RefereeRules&) const = default;
};

/// All that rules had until form 5 of saved states.
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

/// One list of the values, for hash, saved form and whatever must not forget one.
template <class Rules, class Visitor>
void visitRefereeRules(Rules& r, Visitor&& all) {
  visitRefereeRulesOfForm5(r, all);
  all(r.refereeTimeoutTime, r.readyStillTime, r.localStuckReach, r.goalAreaMost, r.doubleTouch);
}

}  // namespace pitchboard::sim
