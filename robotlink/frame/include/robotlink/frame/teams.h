// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The teams of a match, and the names of its robots: the one place that makes a name. Pure
// functions; any thread.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <base/robot_key.h>
#include <simcore/world/world_state.h>

namespace pitchboard::link {

struct Team {
  int number = 0;                   ///< the referee's; 0: not known
  std::string name;                 ///< "RoboFEI"; empty: it has none
  std::optional<TeamColor> colour;  ///< nothing: not known yet
  bool ours = false;
  bool operator==(const Team&) const = default;
};
/// RobotKey::team is the place in here; 0: robots whose team is not known. Where no team is set up,
/// all that are heard are there, and taken for ours.
using Teams = std::vector<Team>;

/// Of the team at this place; nothing: nobody knows.
std::optional<TeamColor> colourAt(int place, const Teams& teams);

/// Those of a simulated match: one for each colour, in the order of TeamColor.
const Teams& teamsByColour();
/// Of a simulated robot, in teamsByColour().
inline RobotKey keyOf(const sim::RobotIdentity& robot) {
  return {static_cast<int>(robot.team) + 1, robot.number, 0};
}

/// Of a live robot as version 0.8 wrote it: one number for team, number, sender and "attached".
/// `hasTeams`: team setups were in use.
RobotKey keyOfOldId(int id, bool hasTeams);

/// "B1" where the team's colour is known, else "Robot 1"; "RoboFEI 1" where an earlier team has the
/// colour, or none, too. Other programs that use the number have their place behind it: "B1 (2)".
std::string robotName(const RobotKey& robot, const Teams& teams);
/// These names may be of one robot: they are equal, or only one of them says the team ("Robot 3" is
/// B3 before the colours are known).
bool isSameRobot(std::string_view name, std::string_view other);
/// Which of the names is meant by `name`: itself, or else the only one that may be of this robot.
std::optional<std::string> robotNamed(std::string_view name, std::span<const std::string> known);

}  // namespace pitchboard::link
