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

/// RobotKey::sender of robots whose blackboards are read; those that are heard count from 0.
inline constexpr int attachedSender = 1000;
constexpr bool isAttached(const RobotKey& robot) {
  return robot.sender >= attachedSender;
}

struct Team {
  int number = 0;                   ///< the referee's; 0: not known
  std::string name;                 ///< "RoboFEI"; empty: it has none
  std::optional<TeamColor> colour;  ///< nothing: not known yet
  bool ours = false;
  bool operator==(const Team&) const = default;
};
/// RobotKey::team is the place in here, from 1.
using Teams = std::vector<Team>;

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
/// colour, too. Other programs that use the number have their place behind it: "B1 (2)".
std::string robotName(const RobotKey& robot, const Teams& teams);
/// The one of `known` that is meant: by its name, or else the only one whose number and sender fit
/// while its team, or that of the name, is not known ("Robot 3" for B3 and the other way round).
std::optional<RobotKey> robotNamed(std::string_view name, const Teams& teams,
                                   std::span<const RobotKey> known);

}  // namespace pitchboard::link
