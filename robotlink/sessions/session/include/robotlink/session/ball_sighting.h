// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where the robots of a frame see the ball, for sources that do not know the true one. Metres, the
// studio's frame. A pure function; any thread.

#include <optional>

#include <robotlink/frame/match_frame.h>

namespace pitchboard::link {

struct BallSighting {
  Point place;
  double sigma = 0.0;  ///< standard deviation
};

/// For a robot that does not tell how uncertain it is about its own place.
inline constexpr double unknownSigma = 0.3;
inline constexpr double minBallSigma = 0.03;

/// Returns where most robots of one team agree that the ball is, else where the nearest one sees
/// it. Robots that do not know where they are, or are offline, do not count.
std::optional<BallSighting> ballSeenIn(const MatchFrame& frame);

}  // namespace pitchboard::link
