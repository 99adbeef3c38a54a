// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The variables that the bridge and the reference processes use, resolved once from a catalog into
// indices. A team's catalog may lack some: reading those gives 0, writing them does nothing.

#include <array>
#include <vector>

#include <robotlink/blackboard.h>
#include <robotlink/variable_catalog.h>

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
  std::array<FloatVar, 4> landmarkDeg;   ///< blue, red, yellow, purple
  std::array<FloatVar, 11> robotDist, robotAngle;  ///< VISION_RBT01.. _DIST / _ANGLE
  std::vector<std::string> missing;      ///< names that the catalog does not have
};

}  // namespace pitchboard::link
