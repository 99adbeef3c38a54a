// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// fork and exec of one child with a clean start: see process_supervisor.h for what it gets.

#include <sys/types.h>
#include <string>
#include <vector>

#include <base/descriptor.h>
#include <base/result.h>

namespace pitchboard::link {

struct Spawned {
  pid_t pid = 0;      ///< also its process group
  Descriptor output;  ///< read end of its standard output and error; non-blocking, close-on-exec
};

/// Starts `command` (program and arguments). From a process with any number of threads: nothing but
/// async-signal-safe calls are made between fork and exec.
Result<Spawned> spawn(const std::vector<std::string>& command);

}  // namespace pitchboard::link
