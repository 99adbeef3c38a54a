// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A run of an experiment's results, played again into a session file. The main thread.

#include <string>

#include <robotlink/experiment/run_player.h>

namespace pitchboard::cli {

/// Error Conflict when it does not end in the state that the results say, unless a team's own
/// programs play in it.
Result<link::RunResult> recordRun(const std::string& folder, const link::Experiment& experiment,
                                  std::size_t number, const std::string& path,
                                  const link::PlaySettings& settings);

}  // namespace pitchboard::cli
