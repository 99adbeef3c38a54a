// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The table of all numbers and switches that people can set in a referee's rules. Rule files, their
// checks and the tables of docs/referee.md are made from it; parameters.h explains a row. Constant
// data; any thread.

#include <array>
#include <string_view>

#include <simcore/world/parameters.h>
#include <simcore/world/referee_rules.h>

namespace pitchboard::sim {

/// Names of the values of RefereeStyle, in its order.
inline constexpr std::array<std::string_view, 3> refereeStyleNames{"humanoid-2014", "humanoid-2021",
                                                                   "humanoid-soccer-2026"};
static_assert(refereeStyleNames.size() == std::size_t(lastOf(RefereeStyle{})) + 1,
              "every RefereeStyle needs its name in refereeStyleNames, and lastOf() the last one");

/// A rule that can be turned on and off.
struct RefereeSwitch {
  const char* key;
  bool RefereeRules::*member;
  const char* name;
};

// clang-format off
inline constexpr auto refereeCounts = std::to_array<Parameter<RefereeRules, int>>({
    {"packet_version", &RefereeRules::packetVersion, units::plain, 7, 20, "Packet version", "Version of the GameController's packets"},
    {"packet_size", &RefereeRules::packetSize, units::plain, 0, 1000, "Packet size", "Bytes, for versions with several sizes"},
    {"shots", &RefereeRules::shots, units::plain, 1, 15, "Shots", "Number of shots of each team in a shoot-out"},
    {"mercy", &RefereeRules::mercy, units::plain, 0, 1000, "Mercy", "Goal difference that ends the match; 0 disables the rule"},
    {"goal_area_most", &RefereeRules::goalAreaMost, units::plain, 0, 100, "In the goal area", "Robots of a team in its own goal area; the last one to enter is removed; 0 disables the rule"},
});

inline constexpr auto refereeParameters = std::to_array<Parameter<RefereeRules>>({
    {"half_time", &RefereeRules::halfTime, units::seconds, 1, 7200, "Half", ""},
    {"extra_half_time", &RefereeRules::extraHalfTime, units::seconds, 1, 7200, "Half of extra time", ""},
    {"break_time", &RefereeRules::breakTime, units::seconds, 0, 7200, "Break", "Time from the end of a half to READY"},
    {"before_match", &RefereeRules::beforeMatch, units::seconds, 0, 3600, "Before the match", "INITIAL before the first READY"},
    {"before_half", &RefereeRules::beforeHalf, units::seconds, 0, 3600, "Before a half", "Shortest time from the end of the previous half to READY"},
    {"ready_time", &RefereeRules::readyTime, units::seconds, 1, 3600, "READY", ""},
    {"set_time", &RefereeRules::setTime, units::seconds, 0, 3600, "SET", "Until the whistle"},
    {"shot_set_time", &RefereeRules::shotSetTime, units::seconds, 0, 3600, "SET before a shot", "In a shoot-out"},
    {"kick_off_time", &RefereeRules::kickOffTime, units::seconds, 0, 600, "Kick-off", "Only the side with the ball may touch it"},
    {"playing_hidden", &RefereeRules::playingHidden, units::seconds, 0, 600, "PLAYING hidden", "Packets announce PLAYING this long after the whistle"},
    {"shot_time", &RefereeRules::shotTime, units::seconds, 1, 600, "Shot", "In a shoot-out"},
    {"timeout_time", &RefereeRules::timeoutTime, units::seconds, 0, 3600, "Timeout", ""},
    {"referee_timeout_time", &RefereeRules::refereeTimeoutTime, units::seconds, 0, 3600, "Referee's timeout", ""},
    {"ready_still_time", &RefereeRules::readyStillTime, units::seconds, 0, 3600, "READY ends early", "READY ends when all robots have stood in position for this time; 0 disables this"},
    {"placing_time", &RefereeRules::placingTime, units::seconds, 0, 600, "Placing", "The ball is placed for a set play; play is stopped"},
    {"prepare_time", &RefereeRules::prepareTime, units::seconds, 0, 600, "Preparing", "Time for the side to move to the ball"},
    {"ready_step_time", &RefereeRules::readyStepTime, units::seconds, 0, 600, "Ready", "Time from the end of preparing until the set play is executed"},
    {"take_time", &RefereeRules::takeTime, units::seconds, 0, 600, "Taking", "Only the side with the ball may touch it"},
    {"penalty_kick_ready", &RefereeRules::penaltyKickReady, units::seconds, 0, 600, "READY before a penalty kick", "0 disables it"},
    {"penalty_kick_time", &RefereeRules::penaltyKickTime, units::seconds, 0, 600, "Penalty kick", ""},
    {"distance_to_ball", &RefereeRules::distanceToBall, units::metres, 0, 10, "Distance to the ball", "Distance that opponents keep in a set play"},
    {"removal_time", &RefereeRules::removalTime, units::seconds, 0, 3600, "Removal", ""},
    {"removal_more", &RefereeRules::removalMore, units::seconds, 0, 3600, "More removal", "Added for each earlier removal of the team"},
    {"motion_time", &RefereeRules::motionTime, units::seconds, 0, 3600, "Motion penalty", "Time that the robot stands still on the field"},
    {"shot_keeper_time", &RefereeRules::shotKeeperTime, units::seconds, 0, 3600, "Removal of a goalkeeper", "In a shoot-out"},
    {"placed_after", &RefereeRules::placedAfter, units::seconds, 0, 600, "Carried out after", "A penalised robot stands for this time before it is put beside the field"},
    {"fallen_time", &RefereeRules::fallenTime, units::seconds, 0, 3600, "Fallen", "Robots that lie longer are removed; 0 disables the rule"},
    {"leaving_time", &RefereeRules::leavingTime, units::seconds, 0, 3600, "Off the field", "Robots that stay outside longer are removed; 0 disables the rule"},
    {"still_time", &RefereeRules::stillTime, units::seconds, 0, 3600, "Ball still", "Drop ball after this time; 0 disables the rule"},
    {"still_distance", &RefereeRules::stillDistance, units::metres, 0, 10, "Ball still within", ""},
    {"nobody_time", &RefereeRules::nobodyTime, units::seconds, 0, 3600, "Ball alone", "Drop ball after this time with nobody within 1 m; 0 disables the rule"},
    {"local_stuck_time", &RefereeRules::localStuckTime, units::seconds, 0, 3600, "Local game stuck", "The nearest robot is removed after the ball has stayed within 0.1 m for this time; 0 disables the rule"},
    {"local_stuck_reach", &RefereeRules::localStuckReach, units::metres, 0, 10, "Stuck within", "Distance from the ball within which a robot is removed"},
    {"pushing_time", &RefereeRules::pushingTime, units::seconds, 0, 3600, "Pushing", "A foul after this time; 0 disables the rule"},
    {"motion_in_set", &RefereeRules::motionInSet, units::metres, 0, 10, "Motion in SET", "Robots that move farther are penalised; 0 disables the rule"},
    {"in_play_distance", &RefereeRules::inPlayDistance, units::metres, 0, 10, "In play after", "Distance that the ball has to move to be in play"},
});

inline constexpr auto refereeSwitches = std::to_array<RefereeSwitch>({
    {"goals", &RefereeRules::goals, "Goals and the ball out of the field"},
    {"throw_ins", &RefereeRules::throwIns, "Throw-ins"},
    {"goal_kicks", &RefereeRules::goalKicks, "Goal kicks"},
    {"corner_kicks", &RefereeRules::cornerKicks, "Corner kicks"},
    {"free_kicks", &RefereeRules::freeKicks, "Free kicks, and the distance of opponents"},
    {"drop_balls", &RefereeRules::dropBalls, "Drop balls"},
    {"kick_off_positions", &RefereeRules::kickOffPositions, "Positions at a kick-off"},
    {"exclusive_ball", &RefereeRules::exclusiveBall, "Touching the ball of the other side at a restart"},
    {"direct_goals", &RefereeRules::directGoals, "No direct goal from a kick-off, throw-in or indirect free kick"},
    {"double_touch", &RefereeRules::doubleTouch, "The taker of a set play touches the ball twice"},
    {"change_sides", &RefereeRules::changeSides, "Teams change sides"},
    {"clock_stops_in_set_plays", &RefereeRules::clockStopsInSetPlays, "The clock stops during set plays"},
    {"escalates", &RefereeRules::escalates, "Each removal is longer than the one before"},
    {"counts_from_call", &RefereeRules::countsFromCall, "Penalties count from the call"},
    {"counts_always", &RefereeRules::countsAlways, "Penalties count in every state"},
    {"pardons_at_play", &RefereeRules::pardonsAtPlay, "A kick-off frees penalised robots"},
    {"half_ends_with_ball", &RefereeRules::halfEndsWithBall, "A half ends when the ball rests"},
    {"knockout", &RefereeRules::knockout, "A tie continues with extra time and shoot-out"},
    {"extra_time", &RefereeRules::extraTime, "Extra time before the shoot-out"},
    {"automatic", &RefereeRules::automatic, "The referee acts automatically"},
});
// clang-format on

}  // namespace pitchboard::sim
