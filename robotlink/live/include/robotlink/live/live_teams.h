// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Applies team setups in Live: the team and colour of a robot, the name of its group of rows, and
// the units of its blackboard variables. Pure functions; any thread.

#include <map>
#include <optional>
#include <string>

#include <robotlink/frame/teams.h>
#include <robotlink/live/live_options.h>
#include <robotlink/live/live_rows.h>

namespace pitchboard::link {

/// Returns the field and the units of variables, for decoders.
telemetry::Surroundings surroundingsOf(const sim::FieldSpec& field);

/// Returns the options of the monitor, with the field of Live.
telemetry::MonitorOptions monitorOptions(const LiveOptions& options);

/// Chooses our team by text: a number in the GameController ("12"; "0": none) or a colour ("red").
/// Fails with InvalidArgument.
Result<void> chooseOurTeam(LiveOptions& options, std::string_view text);
/// Returns our team's number in the GameController, chosen by number or colour; 0 if unknown.
int ourNumber(const LiveOptions& options, const std::optional<Game>& game);
/// Returns the teams, as setups and the referee's game name them.
Teams teamsOf(const LiveOptions& options, const std::optional<Game>& game);

/// Returns the colour in which a robot is drawn; one is chosen if it is unknown.
TeamColor drawnColour(const LiveOptions& options, const RobotKey& robot, const Teams& teams);
/// Returns the name that its team gives it; may be empty.
std::string ownNameOf(const LiveOptions& options, const RobotKey& robot);

/// Returns how groups of rows are named and described; `boards` as in LiveRowsOptions.
LiveRowsOptions rowsOptions(const LiveOptions& options, Teams teams, telemetry::WallTime zero,
                            std::map<RobotUid, std::string> boards = {});

}  // namespace pitchboard::link
