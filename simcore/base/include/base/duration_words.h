// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How long something has lasted, as people say it. The one place for that, below the screen. Pure
// function, any thread; seconds.

#include <string>

namespace pitchboard {

/// "12 s", "32 min 17 s", "5 h 4 min", "3 d 4 h"; what is not over is not counted. `decimals` hold
/// below ten seconds, where they matter: "0.2 s". "–" when it is not known how long.
std::string durationWords(double seconds, int decimals = 0);

}  // namespace pitchboard
