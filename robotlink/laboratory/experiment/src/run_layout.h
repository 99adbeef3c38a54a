// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where a run's values stand: those of the team, three for each robot, those of the file. The names
// are in run_result.cpp, in the same order.

#include <cstddef>
#include <string>
#include <vector>

#include <robotlink/experiment/experiment.h>

namespace pitchboard::link {

enum class TeamValue : std::size_t {
  Success,
  Goal,
  GoalAgainst,
  BallOut,
  Stuck,
  Fell,
  Timeout,
  Goals,
  GoalsAgainst,
  Time,
  TimeToGoal,
  Walked,
  Displacement,
  Kicks,
  Falls,
  BallsOut,
  BeliefError,
  BeliefErrorEnd,
  Possession,
  Collisions,
  Penalties,
  // Of the match, see MatchWatch.
  BallAttended,
  SupportersClose,
  Passes,
  PassesOwn,
  RemovalsTeamHalf,
  RemovalsAgain,
  RemovalsPushing,
  RemovalsIncapable,
  RemovalsPosition,
  RemovalsInSet,
  RemovalsStuck,
  RemovalsLeaving,
  LongestStuck,
  IllegalTransitions,
  Ready
};
inline constexpr std::size_t teamValueCount = 36;

enum class RobotValue : std::size_t { Walked, Kicks, BeliefError };
inline constexpr std::size_t robotValueCount = 3;

/// Names of the robots of all conditions, in the order in which they first appear.
std::vector<std::string> robotsOf(const Experiment& experiment);

}  // namespace pitchboard::link
