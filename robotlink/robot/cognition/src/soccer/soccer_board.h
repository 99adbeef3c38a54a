// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The soccer behaviours' side of a blackboard: reads what they are told in a cycle, and writes what
// team and planning shall know. Use from one thread.

#include <array>
#include <optional>

#include <robotlink/blackboard/robot_variables.h>
#include <robotlink/cognition/soccer_input.h>
#include <simcore/world/field.h>

#include "soccer/aim_habit.h"
#include "soccer/world_model.h"
#include "team/team_variables.h"

namespace pitchboard::link {

/// The variables of an advisor (docs/advisor.md). Their index is -1 if the map lacks them.
struct AdvisorVariables {
  AdvisorVariables();
  FloatVar aim;                                  ///< where the opponents aim: AimHabit::meanAim()
  FloatVar aside;                                ///< cm: keeperShift()
  std::array<IntVar, AimHabit::words> evidence;  ///< AimHabit::asWords()
};

class SoccerBoard {
 public:
  SoccerBoard();
  void read(const Blackboard& board, const WorldModel& world, SoccerInput& input) const;
  /// What vision is to look for (DECISION_ACTION_VISION).
  void lookFor(Blackboard& board, bool opponents) const;
  /// What team and planning shall know, in DECISION_STATE, LOCALIZATION_BALL_*, LOCALIZATION_OPP*
  /// and DECISION_POSITION_*.
  void publish(Blackboard& board, const WorldModel& world, Intention intention,
               const std::optional<Point>& target) const;

 private:
  RobotVariables m_variables{VariableCatalog::extended()};
  TeamVariables m_team;
  AdvisorVariables m_advisor;
  IntVar m_setPlay, m_setPlayOurs;  // of the extension; -1: the map in use has none
};

}  // namespace pitchboard::link
