// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Tells whether team programs play robots of a scenario. Reads runtime profiles, which are files;
// any thread.

#include <base/result.h>
#include <robotlink/scenario/scenario.h>

namespace pitchboard::link {

/// True if a runtime profile of a robot starts a program that is not ours. Fails if a profile
/// cannot be read.
Result<bool> usesTeamPrograms(const Scenario& scenario);

}  // namespace pitchboard::link
