// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How a process is that was started for a robot. In a header of its own, because what shows a match
// needs no more of the process manager.

#include <cstdint>

namespace pitchboard::link {

enum class ProcessState : std::uint8_t {
  Waiting,     ///< for its first start
  Running,     ///<
  Silent,      ///< runs, and shows no sign of life
  Restarting,  ///< ended; it is started again
  Ended,       ///< and is not started again
  Stopped,     ///< by hand
  GivenUp      ///< ended too often
};

}  // namespace pitchboard::link
