// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A run's result as a line of runs.jsonl, and back. Reading refuses what does not fit the
// experiment. Pure.

#include <string>
#include <string_view>

#include <base/result.h>
#include <robotlink/experiment/run_result.h>

namespace pitchboard::link {

std::string lineOf(const RunResult& result);
/// Errors are sentences without a place.
Result<RunResult> resultFromLine(std::string_view line, const Experiment& experiment,
                                 std::size_t metrics);

}  // namespace pitchboard::link
