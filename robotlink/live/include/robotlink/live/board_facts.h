// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What is known of a robot whose blackboard is read on its own computer: by AttachedRobots, and by
// pitchboard-agent when it records. Pure functions; any thread.

#include <base/team_color.h>
#include <telemetry/series/robot_facts.h>

namespace pitchboard::link {

/// Returns the facts about rows of the blackboard with this System V key, which is read `rate`
/// times a second.
telemetry::RobotFacts factsOfBoard(int boardKey, double rate);
/// The same for a robot of its own, with its number on the shirt and its team.
telemetry::RobotFacts factsOfBoard(int boardKey, double rate, int number, TeamColor team);

}  // namespace pitchboard::link
