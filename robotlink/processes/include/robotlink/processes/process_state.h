// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The state of a robot's process. It has a header of its own, because code that shows a match needs
// nothing else from the process manager. Plain value; any thread.

#include <cstdint>

namespace pitchboard::link {

enum class ProcessState : std::uint8_t {
  Waiting,        ///< waits for its first start
  Running,        ///< runs and responds
  NotResponding,  ///< runs without a sign of life
  Restarting,     ///< has ended and will be started again
  Ended,          ///< has ended and will not be started again
  Stopped,        ///< stopped by hand
  GivenUp         ///< has ended too often
};

}  // namespace pitchboard::link
