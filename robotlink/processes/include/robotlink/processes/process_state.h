// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The state of a process of a robot. It has a header of its own, because whoever shows a match
// needs nothing else of the process manager.

#include <cstdint>

namespace pitchboard::link {

enum class ProcessState : std::uint8_t {
  Waiting,        ///< waits for its first start
  Running,        ///<
  NotResponding,  ///< runs without a sign of life
  Restarting,     ///< has ended and will be started again
  Ended,          ///< has ended and will not be started again
  Stopped,        ///< stopped by hand
  GivenUp         ///< has ended too often
};

}  // namespace pitchboard::link
