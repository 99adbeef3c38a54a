// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// fork and exec of one child with a clean start: see child_process.h for what it gets.

#include <sys/types.h>
#include <string>
#include <utility>
#include <vector>

#include <base/result.h>
#include <base/unique_fd.h>

namespace pitchboard::link {

struct SpawnRequest {
  std::vector<std::string> command;  ///< program (looked for in PATH without a '/') and arguments
  std::string directory{};           ///< to run in; empty: ours
  std::vector<std::pair<std::string, std::string>> environment{};  ///< added to ours
  int inherited = -1;                                              ///< becomes its descriptor 3
  int input = -1;         ///< its standard input; else it reads /dev/null
  int output = -1;        ///< its standard output and error; else a pipe to us
  bool outlives = false;  ///< a session of its own, and not ended with us
};

struct Spawned {
  pid_t pid = 0;    ///< also its process group
  UniqueFd output;  ///< read end of its pipe to us; non-blocking, close-on-exec
};

/// Starts a program. From a process with any number of threads: nothing but async-signal-safe calls
/// are made between fork and exec.
Result<Spawned> spawn(const SpawnRequest& request);

}  // namespace pitchboard::link
