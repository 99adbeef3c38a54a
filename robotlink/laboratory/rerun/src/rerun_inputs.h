// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which processes of a robot run again, and what of their inputs a recording has. Private to the
// module; free functions, any thread.

#include <string>
#include <vector>

#include "feed.h"
#include "recorded_robot.h"

namespace pitchboard::link {

/// The chosen processes in the order of their turns, and sentences about those that cannot run.
struct RerunChoices {
  std::vector<RerunProcess> processes;  ///< whole profiles as the processes they consist of
  std::vector<RerunChoice> choices;
  std::vector<std::string> notes;
};

/// Reads what is to run. Fails as rerun() does before it starts.
Result<RerunChoices> chooseProcesses(const telemetry::SessionReader& session,
                                     const RecordedRobot& recorded, const RerunOptions& options);

struct RerunInputs {
  std::vector<std::string> missing;  ///< read, but neither recorded nor written now
  std::vector<std::string> sampled;  ///< known at the times of rows only
  std::vector<std::string> notes;
};

/// `exact` are the processes whose cycles were recorded. Fails with InvalidArgument if a process
/// has none of its inputs.
Result<RerunInputs> checkInputs(const RecordedRobot& recorded,
                                const std::vector<RerunChoice>& choices, const Feed& feed,
                                const std::vector<std::string>& exact);

}  // namespace pitchboard::link
