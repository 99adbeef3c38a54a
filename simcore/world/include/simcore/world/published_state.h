// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The state of the `published` model, in the published frame: window centimetres with y down,
// degrees. A conversion to metres and back would not return the same bits. Plain values; any
// thread.

#include <vector>

namespace pitchboard::sim {

struct PublishedRobot {
  double x = 0.0, y = 0.0;  ///< cm
  double rotate = 0.0;      ///< heading, degrees in [0, 360]
  double view = 0.0;        ///< head direction in the field (not relative to the body), degrees
  bool panRight = true;     ///< direction of the search
  int action = 0;           ///< control's current action
  double front = 0.0, turn = 0.0, drift = 0.0;  ///< per frame, set by control
  bool inMotion = false;
  double orientationError = 0.0;  ///< degrees
  bool operator==(const PublishedRobot&) const = default;
};

struct PublishedBall {
  double x = 520.0, y = 370.0;  ///< cm
  double vx = 0.0, vy = 0.0;    ///< cm per frame
  double friction = 0.95;       ///< share of the speed kept each frame
  bool operator==(const PublishedBall&) const = default;
};

struct PublishedState {
  std::vector<PublishedRobot> robots;
  PublishedBall ball;
  bool operator==(const PublishedState&) const = default;
};

}  // namespace pitchboard::sim
