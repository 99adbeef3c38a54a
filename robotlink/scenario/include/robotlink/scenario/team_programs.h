// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Whether robots of a scenario are played by programs that their team wrote. Reads runtime
// profiles; any thread.

#include <string_view>

#include <base/result.h>
#include <robotlink/scenario/scenario.h>

namespace pitchboard::link {

/// True if a runtime profile of a robot starts a program that is not ours. Such programs only run
/// as separate processes: without `separate` they are refused with InvalidArgument, a sentence that
/// names the robot and its runtime and ends with `remedy`. Also fails if a profile cannot be read.
Result<bool> usesTeamPrograms(const Scenario& scenario, bool separate, std::string_view remedy);

}  // namespace pitchboard::link
