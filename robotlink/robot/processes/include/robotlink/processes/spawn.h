// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Starts a child process by fork and exec, with a clean state; child_process.h describes it.

#include <sys/types.h>
#include <string>
#include <utility>
#include <vector>

#include <base/result.h>
#include <base/unique_fd.h>

namespace pitchboard::link {

struct SpawnRequest {
  std::vector<std::string> command;  ///< program (searched in PATH if it has no '/') and arguments
  std::string directory{};           ///< working directory; empty: ours
  std::vector<std::pair<std::string, std::string>> environment{};  ///< added to ours
  int inherited = -1;                                              ///< becomes its descriptor 3
  int input = -1;         ///< its standard input; otherwise /dev/null
  int output = -1;        ///< its standard output and error; otherwise a pipe to us
  bool outlives = false;  ///< it has a session of its own and outlives us
};

struct Spawned {
  pid_t pid = 0;    ///< process number, and its process group
  UniqueFd output;  ///< read end of its pipe to us; non-blocking, close-on-exec
};

/// Starts a program. Safe in a process with several threads: only async-signal-safe calls are made
/// between fork and exec.
Result<Spawned> spawn(const SpawnRequest& request);

}  // namespace pitchboard::link
