// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How a tournament becomes an experiment, and what its assertions are made of. Private to the
// module.

#include <robotlink/experiment/experiment_summary.h>
#include <robotlink/experiment/tournament.h>

#include "experiment_reader.h"

namespace pitchboard::link {

/// Adds the conditions of e.tournament, and says whose experiment it is. The first error is in the
/// report.
void addMatches(Experiment& e, ConditionParts& parts, std::size_t matches, const JsonObject& root,
                JsonReport& report);
/// Matches go to the final whistle where the scenario has one and no other end was asked for.
void playToTheWhistle(Experiment& e, bool hasStop);
/// Conditions, with all that follows from them.
bool makeWhole(Experiment& e, const ConditionParts& parts, const JsonObject& root,
               JsonReport& report);

/// What a TeamAssertion may name.
std::vector<MetricInfo> tournamentMetrics();
std::vector<CheckedAssertion> checkedAssertions(const Experiment& experiment,
                                                const ResultTable& results);

}  // namespace pitchboard::link
