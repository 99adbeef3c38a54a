// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads recorded moments from memory (StateArchive and SeriesStore) or from a session file. Any
// thread that may read these.

#include <cstdint>
#include <span>
#include <vector>

#include <base/result.h>
#include <robotlink/blackboard/variable_catalog.h>
#include <robotlink/frame/match_frame.h>
#include <robotlink/match/moment.h>
#include <robotlink/scenario/scenario.h>
#include <telemetry/series/series_store.h>
#include <telemetry/session/session_reader.h>

namespace pitchboard::link {

class SimulatedMatch;
class StateArchive;

/// Returns a robot's blackboard from rows: every word of `catalog` for which there is a column.
std::vector<BoardWord> boardWords(const telemetry::GroupInfo& group, const telemetry::RowView& row,
                                  const VariableCatalog& catalog);

/// Returns the present moment of a match, with what its processes remember if `archive`, which
/// observes the match, knows it. Call it on the match's thread.
Moment presentMoment(const SimulatedMatch& match, const StateArchive& archive);

/// Returns the moment at a tick, with the blackboards from the rows at that time. Fails with
/// NotFound if the tick is not in the archive; if rows are missing, blackboards are left out.
Result<Moment> momentFromMemory(const StateArchive& archive, const telemetry::SeriesStore& rows,
                                std::uint64_t tick, const VariableCatalog& catalog);

/// Returns the moment at or before `seconds` of a session file. Fails with NotFound if the file has
/// no checkpoint there, as in a live recording or another program's file.
Result<Moment> momentFromSession(const telemetry::SessionReader& session, double seconds,
                                 const VariableCatalog& catalog);

/// Returns the exact state of the moment that a frame of a session shows. Fails with NotFound if
/// the file has no checkpoint there.
Result<sim::WorldState> stateOfFrame(const telemetry::SessionReader& session,
                                     const MatchFrame& frame);

/// Makes the game and the rules of a scenario those of a state; what a scenario says of its game is
/// the beginning. If the state is unknown, the scenario has no game any more.
void setGameOf(const Result<sim::WorldState>& state, Scenario& scenario);

}  // namespace pitchboard::link
