// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A recorded moment of a simulated match: the exact state of the world, and what stood on the
// robots' blackboards. From memory (StateArchive and SeriesStore) or from a session file. Plain
// values.

#include <cstdint>
#include <string>
#include <vector>

#include <robotlink/blackboard.h>
#include <robotlink/variable_catalog.h>
#include <simcore/world_state.h>
#include <telemetry/series_store.h>
#include <telemetry/session_reader.h>

namespace pitchboard::link {

class StateArchive;

/// One word of a blackboard, as its bits.
struct BoardWord {
  int index = 0;
  std::uint32_t bits = 0;
  bool operator==(const BoardWord&) const = default;
};

struct MomentRobot {
  RobotId id;
  std::string behaviour;
  std::vector<BoardWord> words;  ///< those that are known; the others are left as they are
  void writeTo(Blackboard& board) const;
};

struct Moment {
  sim::WorldState state;
  std::vector<MomentRobot> robots;
  /// Null when nothing is known of this robot.
  const MomentRobot* robot(RobotId id) const;
};

/// What rows say of a robot's blackboard: every word of `catalog` that the group has a column for.
std::vector<BoardWord> boardWords(const telemetry::GroupInfo& group,
                                  std::span<const std::uint32_t> words,
                                  const VariableCatalog& catalog);

/// The moment at a tick, with the blackboards from the rows at that time. Error NotFound when the
/// tick is not in the archive; missing rows only leave blackboards out.
Result<Moment> momentFromMemory(const StateArchive& archive, const telemetry::SeriesStore& rows,
                                std::uint64_t tick, const VariableCatalog& catalog);

/// The moment at or before `seconds` of a session file. Error NotFound when the file has no state
/// of a simulated match there (a live recording, or another program's file).
Result<Moment> momentFromSession(const telemetry::SessionReader& session, double seconds,
                                 const VariableCatalog& catalog);

}  // namespace pitchboard::link
