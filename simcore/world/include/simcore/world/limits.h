// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How far a world goes: what scenarios and experiments may ask for, and what physics keeps to.
// Plain constants, SI units. Any thread.

namespace pitchboard::sim {

inline constexpr double fastestBall = 50.0;  // m/s
inline constexpr int highestShirtNumber = 99;

}  // namespace pitchboard::sim
