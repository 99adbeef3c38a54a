// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A run of an experiment's results, played again into a session file. The main thread.

#include <string>

#include <robotlink/experiment/run_player.h>

namespace pitchboard::cli {

/// "results/sessions/run-000417.mcap".
std::string sessionPath(const std::string& folder, std::size_t number);

/// Error Conflict when it does not end in the state that the results say.
Result<link::RunResult> recordRun(const std::string& folder, const link::Experiment& experiment,
                                  std::size_t number, const std::string& path,
                                  const link::PlaySettings& settings);

}  // namespace pitchboard::cli
