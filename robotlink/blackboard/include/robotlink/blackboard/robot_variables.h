// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The variables that the bridge and the reference processes use, resolved once from a catalog into
// indices. A team's catalog may lack some: readOr() gives 0 for those, writeIfPresent() does
// nothing.

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
  /// VISION_RBT01.. _DIST / _ANGLE; the published map ends at 11, which is nothing missing.
  std::array<FloatVar, 22> robotDist, robotAngle;
  std::vector<std::string> missing;  ///< names that the catalog does not have
};

// How bridge and processes use them: an absent variable reads as `fallback` and is never written.
// (Blackboard::read and write take the index as it is.)
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
/// Says whether `expected` stood there and was replaced.
inline bool replaceIfPresent(Blackboard& board, IntVar variable, int expected, int value) {
  return isPresent(variable) && board.replace(variable, expected, value);
}

}  // namespace pitchboard::link
