// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Limits of a simulated world, which scenarios, experiments and the physics share. Constants in SI
// units; any thread.

namespace pitchboard::sim {

inline constexpr double fastestBall = 50.0;  ///< m/s
inline constexpr int highestShirtNumber = 99;

}  // namespace pitchboard::sim
