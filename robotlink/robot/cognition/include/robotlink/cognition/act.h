// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// An order of the decision process to the control process: the values of DECISION_ACTION_A and
// DECISION_ACTION_B. A plain value; any thread.

namespace pitchboard::link {

struct Act {
  int action = 0;
  int b = 0;
  bool operator==(const Act&) const = default;
};

namespace acts {
inline constexpr Act stop{0, 0}, forward{1, 0}, turnLeft{2, 0}, turnRight{3, 0}, kickRight{4, 0},
    kickLeft{5, 0}, sidleLeft{6, 0}, sidleRight{7, 0}, forwardSlow{8, 10}, aroundLeft{9, 0},
    gait{11, 0}, aroundRight{14, 0}, backward{17, 0}, backwardSlow{18, 0}, weakKickRight{21, 0},
    weakKickLeft{22, 0}, passLeft{12, 0}, passRight{13, 0};

/// Turns left for a positive angle, else right.
constexpr Act turn(double angle) {
  return angle > 0.0 ? turnLeft : turnRight;
}
}  // namespace acts

}  // namespace pitchboard::link
