// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where this program and the programs that were installed with it are. Any thread.

#include <string>

#include <base/result.h>

namespace pitchboard::link {

/// The file that this process runs.
Result<std::string> teamProgram();

/// The program `name` in the same folder; only the name, which is then looked for in PATH, when the
/// system does not tell the folder.
std::string besideTeamProgram(const std::string& name);

}  // namespace pitchboard::link
