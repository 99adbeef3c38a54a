// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The columns in which a recording keeps the referee's game: what a scoreboard shows of it, of the
// match and of each robot, and the game made from them again. Whole seconds. Without a referee the
// first column is 0 and the others say nothing. Private to robotlink; pure functions.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <robotlink/session/row_slot.h>
#include <simcore/world/world_state.h>
#include <telemetry/series/series_types.h>

namespace pitchboard::link {

inline constexpr std::size_t gameColumnCount = 17;
std::vector<telemetry::ColumnInfo> gameColumns();
void readGame(const sim::WorldState& world, std::span<double> out);

inline constexpr std::size_t playerColumnCount = 8;
std::vector<telemetry::ColumnInfo> playerColumns();
void readPlayer(const sim::WorldState& world, const sim::RobotIdentity& robot,
                std::span<double> out);

/// Where a group of rows has them.
struct GameSlots {
  explicit GameSlots(const telemetry::GroupInfo& match);
  std::array<RowSlot, gameColumnCount> slots;
};
struct PlayerSlots {
  explicit PlayerSlots(const telemetry::GroupInfo& robot);
  std::array<RowSlot, playerColumnCount> slots;
};

/// As much of a game and its rules as a scoreboard shows. Times are whole seconds.
struct RecordedGame {
  Game game;
  sim::RefereeRules rules;
};
/// Returns nothing when there was no referee.
std::optional<RecordedGame> gameFromRow(const GameSlots& slots, const telemetry::RowView& row);
/// Adds the last of these robots to the game, which has the others.
void addPlayer(const PlayerSlots& slots, const telemetry::RowView& row,
               std::span<const sim::RobotIdentity> robots, Game& game);

}  // namespace pitchboard::link
