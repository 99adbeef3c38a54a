// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the kernel tells of running processes. Any thread.

#include <sys/types.h>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <robotlink/processes/child_process.h>

namespace pitchboard::link {

struct ProcessUse {
  char state = '?';         ///< R, S, T (stopped), Z
  double cpuSeconds = 0.0;  ///< since its start
  std::uint64_t memoryBytes = 0;
};

/// How a program works.
struct ProcessRhythm {
  /// In which it worked, or could have if a core had been free; not every system tells.
  std::optional<double> readySeconds;
  /// How often it went to sleep by itself: a periodic one does each cycle.
  std::uint64_t sleeps = 0;
};

/// Nothing once it is gone.
std::optional<ProcessUse> processUse(pid_t pid);
std::optional<ProcessRhythm> processRhythm(pid_t pid);

/// It has attached to this System V segment. True where the system does not let us look.
bool mapsSegment(pid_t pid, int shmid);
/// It has loaded a file of this name. True where the system does not let us look.
bool mapsFile(pid_t pid, std::string_view name);

/// What it started, and what that started, parents first. Not what was left behind by a process
/// that is gone, unless `pid` is its keeper.
std::vector<pid_t> descendantsOf(pid_t pid);

/// Changes when the program, or a script among its arguments, is replaced; empty when there is
/// none.
std::string programStamp(const ChildSpec& spec);

}  // namespace pitchboard::link
