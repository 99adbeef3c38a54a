// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What Live makes of team setups: whose a robot is, in which colour, under which name its rows
// stand, and in which units its blackboard variables are. Pure functions; any thread.

#include <map>
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

/// Who plays, as setups and the referee say it; null: none was heard.
Teams teamsOf(const LiveOptions& options, const telemetry::RefereeState* referee);

/// The colour that a robot is drawn in; one is chosen where nobody knows it.
TeamColor drawnColour(const LiveOptions& options, const RobotKey& robot, const Teams& teams);
/// What its team calls it; empty: nothing.
std::string ownNameOf(const LiveOptions& options, const RobotKey& robot);

/// How the groups of rows are called and described; `boards`: LiveRowsOptions::boards.
telemetry::LiveRowsOptions rowsOptions(const LiveOptions& options, Teams teams,
                                       telemetry::WallTime zero,
                                       std::map<RobotKey, std::string> boards = {});

}  // namespace pitchboard::link
