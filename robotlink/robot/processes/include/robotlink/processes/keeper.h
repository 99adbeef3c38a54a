// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The keeper of a team program: a small process between us and it, to which the kernel hands every
// process that the program started and left behind (PR_SET_CHILD_SUBREAPER). It starts the program,
// ends as the program ended, and leaves nothing running, whatever the program's children did to
// their group, session and environment. It also ends all of them if we end.

#include <string>
#include <string_view>
#include <vector>

#include <robotlink/processes/spawn.h>

namespace pitchboard::link {

/// The hidden command of pitchboard-robot that runs the keeper.
inline constexpr std::string_view keepCommand = "keep";

struct Kept {
  Spawned keeper;    ///< its output is that of the program
  UniqueFd control;  ///< each byte is a signal to send; closing it kills all
  pid_t program = 0;
};

/// Starts a program with its keeper, which `robotProgram` runs. Fails as spawn() does.
Result<Kept> spawnKept(const SpawnRequest& request, const std::string& robotProgram);

/// Runs the keeper; `arguments` come from spawnKept(). It is the only thread of its process, and
/// returns only if the program cannot be started.
void keep(const std::vector<std::string>& arguments);

}  // namespace pitchboard::link
