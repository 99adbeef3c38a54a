// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The keeper of a team's program: a small process between us and it, to which the kernel gives
// every process that the program started and left behind (PR_SET_CHILD_SUBREAPER). It starts the
// program, ends as the program ended, and leaves nothing running, whatever the program's children
// did to their group, session and environment. It also ends all of them when we are gone.

#include <string>
#include <string_view>
#include <vector>

#include <robotlink/processes/spawn.h>

namespace pitchboard::link {

/// The hidden command of pitchboard-robot that runs it.
inline constexpr std::string_view keepCommand = "keep";

struct Kept {
  Spawned keeper;    ///< its output is the program's
  UniqueFd control;  ///< a byte is the number of a signal; its end kills all
  pid_t program = 0;
};

/// Starts a program and its keeper, run by `robotProgram`. Errors are those of spawn().
Result<Kept> spawnKept(const SpawnRequest& request, const std::string& robotProgram);

/// The keeper; `words` come from spawnKept(). The only thread of its process. Returns only if the
/// program cannot be started.
void keep(const std::vector<std::string>& words);

}  // namespace pitchboard::link
