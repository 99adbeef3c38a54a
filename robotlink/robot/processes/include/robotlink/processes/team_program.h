// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Finds this program and the programs that were installed with it. Pure functions; any thread.

#include <string>

#include <base/result.h>

namespace pitchboard::link {

/// Returns the path of the running program.
Result<std::string> teamProgram();

/// Returns the path of the program `name` in the same folder, or only the name, which is then
/// searched in PATH, if the folder is unknown.
std::string besideTeamProgram(const std::string& name);

}  // namespace pitchboard::link
