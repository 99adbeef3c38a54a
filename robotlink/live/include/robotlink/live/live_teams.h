// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What Live makes of team setups: whose a robot is, in which colour, under which name its rows
// stand, and in which units its blackboard variables are. Pure functions; any thread.

#include <optional>
#include <string>

#include <robotlink/frame/teams.h>
#include <robotlink/live/live_rows.h>
#include <robotlink/live/live_watch.h>

namespace pitchboard::link {

/// Field and units of variables, for decoders.
telemetry::Surroundings surroundingsOf(const sim::FieldSpec& field);

/// The options of the monitor with the field of Live in them.
telemetry::MonitorOptions monitorOptions(const LiveOptions& options);

/// For the names of robots.
Teams teamsOf(const std::vector<telemetry::TeamSetup>& setups);

/// The colour that a robot is drawn in. `ours`: of a team without a colour, as the referee says it.
TeamColor colourOf(const LiveOptions& options, const RobotKey& robot, TeamColor ours,
                   const std::optional<RefereeView>& referee);
/// The referee's number of its team; 0: not known.
int refereeNumberOf(const LiveOptions& options, const RobotKey& robot);
/// What its team calls it; empty: nothing.
std::string ownNameOf(const LiveOptions& options, const RobotKey& robot);

/// Attribute of a group that names its column of this meaning, for robots of team setups.
std::string meaningAttribute(telemetry::FieldMeaning meaning);

/// Names and attributes of the groups of rows. With teams, or where the messages have blackboard
/// variables, a robot is called as in a simulation ("B3"), else "Robot 3"; "B3 heard" where an
/// attached blackboard is B3.
telemetry::LiveRowsOptions rowsOptions(const LiveOptions& options, telemetry::WallTime zero);

}  // namespace pitchboard::link
