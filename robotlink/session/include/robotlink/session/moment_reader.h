// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads recorded moments: from memory (StateArchive and SeriesStore) or from a session file. Any
// thread that may read those.

#include <cstdint>
#include <span>
#include <vector>

#include <base/result.h>
#include <robotlink/blackboard/variable_catalog.h>
#include <robotlink/match/moment.h>
#include <telemetry/series/series_store.h>
#include <telemetry/session/session_reader.h>

namespace pitchboard::link {

class SimulatedMatch;
class StateArchive;

/// What rows say of a robot's blackboard: every word of `catalog` that the group has a column for.
std::vector<BoardWord> boardWords(const telemetry::GroupInfo& group,
                                  std::span<const std::uint32_t> words,
                                  const VariableCatalog& catalog);

/// The present moment of a match, with what its processes remember as far as `archive`, which sees
/// the match, knows. On the match's thread.
Moment presentMoment(const SimulatedMatch& match, const StateArchive& archive);

/// The moment at a tick, with the blackboards from the rows at that time. Error NotFound when the
/// tick is not in the archive; missing rows only leave blackboards out.
Result<Moment> momentFromMemory(const StateArchive& archive, const telemetry::SeriesStore& rows,
                                std::uint64_t tick, const VariableCatalog& catalog);

/// The moment at or before `seconds` of a session file. Error NotFound when the file has no state
/// of a simulated match there (a live recording, or another program's file).
Result<Moment> momentFromSession(const telemetry::SessionReader& session, double seconds,
                                 const VariableCatalog& catalog);

}  // namespace pitchboard::link
