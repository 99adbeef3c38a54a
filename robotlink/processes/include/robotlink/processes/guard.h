// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The guard of a supervisor: a small process that outlives it. While the supervisor lives it does
// nothing; when that is killed, the guard ends all that was started (also what left its group or
// lost its parent: every process bears a mark) and removes the segments that nobody uses any more.
// The supervisor tells it what there is over a socket, a line for each; the end of the socket
// without "done" means that it was killed.

#include <string>
#include <string_view>

namespace pitchboard::link {

/// The hidden command of pitchboard-robot that runs it, with the mark behind.
inline constexpr std::string_view guardCommand = "guard";

namespace guardWords {
inline constexpr const char* done = "done\n";
inline std::string segment(int key, int shmid) {
  return "segment " + std::to_string(key) + ' ' + std::to_string(shmid) + '\n';
}
}  // namespace guardWords

/// Reads `input` to its end and does what is then to be done. The only thread of its program.
void runGuard(const std::string& mark, int input);

}  // namespace pitchboard::link
