// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The published naive behaviour: turn to the ball, walk to it, kick it. Pure functions, except for
// the process itself, which is for one thread at a time.

#include <memory>
#include <optional>

#include <robotlink/blackboard/robot_variables.h>
#include <robotlink/cognition/cognitive_process.h>

namespace pitchboard::link {

/// What a cycle of the naive behaviour writes to the blackboard while the referee says "play".
struct NaiveOutput {
  int actionA = 0;             ///< DECISION_ACTION_A
  std::optional<int> actionB;  ///< DECISION_ACTION_B
  bool searchOn = false;       ///< true: DECISION_SEARCH_ON = 1; false: leave it as it is
  bool operator==(const NaiveOutput&) const = default;

  /// Writes B before A, because control reads B when it sees a new A.
  void writeTo(Blackboard& board, const RobotVariables& variables) const;
};

/// Applies the rule to VISION_LOST, VISION_PAN_DEG (degrees, left positive) and VISION_BALL_DIST
/// (cm); `distanceToKick` is in cm. It copies the published behaviour with its known faults: a ball
/// at exactly 50 cm, or between distanceToKick and 20 cm, makes the robot step in place, and the
/// bearing is truncated to whole degrees. The only difference: values that crash the published
/// process (NaN, infinity) count as a lost ball.
NaiveOutput naiveRule(int lost, float panDeg, float distance, double distanceToKick);

/// Makes the decision process with this behaviour. `options.parameters` must be valid.
Result<std::unique_ptr<CognitiveProcess>> makeNaiveDecision(const ProcessOptions& options);

}  // namespace pitchboard::link
