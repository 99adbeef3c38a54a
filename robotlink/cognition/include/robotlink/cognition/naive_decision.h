// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The published naive behaviour (system.md section 6): turn to the ball, walk to it, kick it.

#include <memory>
#include <optional>

#include <robotlink/blackboard/robot_variables.h>
#include <robotlink/cognition/cognitive_process.h>

namespace pitchboard::link {

/// What one cycle of the naive behaviour writes while the referee says "play".
struct NaiveOutput {
  int actionA = 0;             ///< DECISION_ACTION_A
  std::optional<int> actionB;  ///< DECISION_ACTION_B
  bool searchOn = false;       ///< DECISION_SEARCH_ON = 1 is to be written
  bool operator==(const NaiveOutput&) const = default;

  /// B before A, because control reads B in the moment it sees a new A.
  void writeTo(Blackboard& board, const RobotVariables& variables) const;
};

/// The rule itself, from VISION_LOST, VISION_PAN_DEG (degrees, left positive) and VISION_BALL_DIST
/// (cm); `distanceToKick` in cm. As published, to its known faults: a ball at exactly 50 cm, or
/// between distanceToKick and 20 cm, makes it gait in place, and the bearing is truncated to whole
/// degrees. Only values that would have ended the published process (nan, infinite) are new: they
/// count as a lost ball. Pure; any thread.
NaiveOutput naiveRule(int lost, float panDeg, float distance, double distanceToKick);

/// The decision process with that behaviour. Its `options.parameters` must be valid.
Result<std::unique_ptr<CognitiveProcess>> makeNaiveDecision(const ProcessOptions& options);

}  // namespace pitchboard::link
