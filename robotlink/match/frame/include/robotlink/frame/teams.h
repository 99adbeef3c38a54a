// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The teams of a match, and the names of robots. All names of robots are made here. Plain values
// and pure functions; any thread.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/robot_key.h>
#include <simcore/world/world_state.h>

namespace pitchboard::link {

struct Team {
  int number = 0;                   ///< number in the GameController; 0: unknown
  std::string name;                 ///< "RoboFEI"; empty if it has none
  std::optional<TeamColor> colour;  ///< empty if unknown
  bool ours = false;
  bool operator==(const Team&) const = default;
};
/// All teams of a match; RobotKey::team is an index into this list. Index 0 stands for robots whose
/// team is unknown. If no team is set up, all received robots are there, and they count as ours.
using Teams = std::vector<Team>;

/// Returns the colour of the team with this index; empty if it is unknown.
std::optional<TeamColor> colourAt(int place, const Teams& teams);
/// Returns the name of the team with this number in the GameController; empty if it has none.
std::string_view teamName(int number, const Teams& teams);
/// Returns the position of this robot in lists.
RobotOrder orderOf(const RobotKey& robot, const Teams& teams);

/// Returns the teams of a simulated match: one for each colour, in the order of TeamColor.
const Teams& teamsByColour();
/// Fills `teams` with these, and the names and numbers of a scenario.
void fillTeams(const std::vector<sim::TeamSettings>& settings, Teams& teams);
/// Returns the index of this colour's team in teamsByColour().
constexpr int teamIndex(TeamColor colour) {
  return static_cast<int>(colour) + 1;
}
/// Returns the key of a simulated robot, for teamsByColour().
inline RobotKey keyOf(const sim::RobotIdentity& robot) {
  return {teamIndex(robot.team), robot.number, 0};
}

/// Returns the robot of a simulated match with this slot.
inline RobotUid uidOf(RobotId slot) {
  return {static_cast<std::uint32_t>(slot.value)};
}

/// Returns an uid for a robot of which only the key is known, as of sessions before 0.23. No other
/// robot has it.
RobotUid uidOf(const RobotKey& robot);

/// Converts the number with which version 0.8 identified a live robot: it combined team, number,
/// sender and "attached". `hasTeams` tells whether team setups were in use.
RobotKey keyOfOldId(int id, bool hasTeams);

/// Returns the name of a robot: "B1" if the team's colour is known, otherwise "Robot 1", or
/// "RoboFEI 1" if an earlier team has the same colour or none either. A second program with the
/// same number is "B1 (2)". A simulated robot that Live receives is "Simulated 1".
std::string robotName(const RobotKey& robot, const Teams& teams);

}  // namespace pitchboard::link
