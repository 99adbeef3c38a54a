// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The guard of a match: a small process that outlives it. If the match is killed, the guard removes
// its segments that no process uses. The match sends the name of each segment over a socket, one
// per packet; if the socket is closed without "done", the match was killed.

#include <string>
#include <string_view>

namespace pitchboard::link {

/// The hidden command of pitchboard-robot that runs the guard.
inline constexpr std::string_view guardCommand = "guard";

namespace guardMessages {
inline constexpr const char* done = "done";
inline std::string segment(int key, int shmid) {
  return "segment " + std::to_string(key) + ' ' + std::to_string(shmid);
}
}  // namespace guardMessages

/// Reads `input` to its end, then cleans up. It is the only thread of its program.
void runGuard(int input);

}  // namespace pitchboard::link
