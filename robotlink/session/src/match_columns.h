// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The columns that a simulated match has beside its blackboards: truth, what the robots believe and
// how far that is from the truth, and the match itself with its referee's game. Lengths in m and
// angles in degrees (studio frame) for truth and belief; errors in cm and degrees, as the robots
// count. Private to robotlink.

#include <span>
#include <vector>

#include <robotlink/match/simulated_match.h>
#include <telemetry/series/series_types.h>

namespace pitchboard::link {

std::vector<telemetry::ColumnInfo> truthColumns();
/// In the order of truthColumns(); NaN where there is nothing to say (ball not seen, no belief
/// yet).
void readTruth(const SimulatedMatch& match, const sim::Snapshot& snapshot,
               const sim::RobotSnapshot& robot, const Blackboard& board, std::span<double> out);

std::vector<telemetry::ColumnInfo> matchColumns();
void readMatch(const sim::WorldState& world, const sim::Snapshot& snapshot, double tickTime_us,
               std::span<double> out);

}  // namespace pitchboard::link
