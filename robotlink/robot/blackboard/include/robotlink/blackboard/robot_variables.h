// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The variables that the bridge and the reference processes use, as indices that are looked up once
// in a catalog. A team's catalog may lack some: readOr() returns a fallback for those, and
// writeIfPresent() does nothing. Plain values; any thread.

#include <array>
#include <vector>

#include <robotlink/blackboard/blackboard.h>
#include <robotlink/blackboard/variable_catalog.h>

namespace pitchboard::link {

/// An absent variable has index −1.
struct RobotVariables {
  explicit RobotVariables(const VariableCatalog& catalog = VariableCatalog::published());

  IntVar decisionActionA, decisionActionB, decisionSearchOn, decisionActionVision,
      decisionLocalization, imuReset, imuState, controlAction, controlMoving, voltage, visionLost,
      controlWorking, visionWorking, localizationWorking, decisionWorking, imuWorking, comReferee,
      localizationX, localizationY, localizationTheta, robotNumber;
  FloatVar imuEulerX, imuEulerY, imuEulerZ, imuGyroX, imuGyroY, imuGyroZ, imuAccelX, imuAccelY,
      imuAccelZ, visionBallDist, visionBallAngle, visionPanDeg, visionTiltDeg, localizationBelief;
  std::array<FloatVar, 4> landmarkDeg;  ///< blue, red, yellow, purple
  /// VISION_RBT01_DIST, _ANGLE and so on. The published map ends at 11, which is no error.
  std::array<FloatVar, 22> robotDist, robotAngle;
  std::vector<std::string> missing;  ///< names that the catalog does not have

 private:
  struct LookedUp {};
  RobotVariables(const VariableCatalog& catalog, LookedUp look);
};

// Access for bridge and processes: an absent variable reads as `fallback` and is never written.
// (Blackboard::read and write require a valid index.)
constexpr bool isPresent(IntVar variable) {
  return variable.index >= 0;
}
constexpr bool isPresent(FloatVar variable) {
  return variable.index >= 0;
}

inline int readOr(const Blackboard& board, IntVar variable, int fallback = 0) {
  return isPresent(variable) ? board.read(variable) : fallback;
}
inline float readOr(const Blackboard& board, FloatVar variable, float fallback = 0.0F) {
  return isPresent(variable) ? board.read(variable) : fallback;
}
inline void writeIfPresent(Blackboard& board, IntVar variable, int value) {
  if (isPresent(variable)) board.write(variable, value);
}
inline void writeIfPresent(Blackboard& board, FloatVar variable, float value) {
  if (isPresent(variable)) board.write(variable, value);
}
/// Returns whether the variable was `expected` and was replaced.
inline bool replaceIfPresent(Blackboard& board, IntVar variable, int expected, int value) {
  return isPresent(variable) && board.replace(variable, expected, value);
}

}  // namespace pitchboard::link
