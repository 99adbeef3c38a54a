// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The errors of the simulated body and senses. Standard deviations are of normal noise with mean 0.
// Motion and drift are per frame of 1/60 s and scaled with the square root of the tick, so that the
// tick rate does not change their strength. 0 switches a source off. Presets are data:
// resources/noise/*.json. Plain values; any thread.

namespace pitchboard::sim {

struct NoiseParameters {
  double forward = 0.0;              ///< m per 1/60 s, while the robot is in motion
  double sideways = 0.0;             ///< m per 1/60 s, while the robot is in motion
  double rotation = 0.0;             ///< rad per 1/60 s, while the robot is in motion
  double kickSpeed = 0.0;            ///< m/s
  double kickAngle = 0.0;            ///< rad
  double visionDistance = 0.0;       ///< share of the distance to the ball (0.1 = 10 %)
  double visionBearing = 0.0;        ///< rad, ball
  double robotDistance = 0.0;        ///< m, team-mates and opponents
  double robotBearing = 0.0;         ///< rad, team-mates and opponents
  double landmarkBearing = 0.0;      ///< rad
  double landmarkProbability = 1.0;  ///< probability that a landmark in view is seen in a frame
  double missedDetection = 0.0;      ///< probability that a ball or robot in view is not seen
  double visionDelay = 0.0;          ///< s from seeing something to writing it
  double imuWhite = 0.0;             ///< rad, on the yaw, per tick
  double imuDrift = 0.0;             ///< rad per 1/60 s, accumulates on the yaw
  /// True: every robot has the noise of its own model, and the numbers here are ignored.
  bool ofModel = false;

  bool operator==(const NoiseParameters&) const = default;
};

}  // namespace pitchboard::sim
