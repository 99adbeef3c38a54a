// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/blackboard/robot_variables.h>

#include <cstdio>

namespace pitchboard::link {
namespace {

// One place that turns names into indices and remembers the names that are missing.
struct Resolver {
  const VariableCatalog& catalog;
  std::vector<std::string>& missing;

  IntVar intVar(std::string_view name) {
    if (const auto found = catalog.intVar(name)) return *found;
    missing.emplace_back(name);
    return IntVar{-1};
  }
  FloatVar floatVar(std::string_view name) {
    if (const auto found = catalog.floatVar(name)) return *found;
    missing.emplace_back(name);
    return FloatVar{-1};
  }
};

}  // namespace

RobotVariables::RobotVariables(const VariableCatalog& catalog) {
  // Every process of a simulated robot needs those of the built-in maps.
  static const RobotVariables published(VariableCatalog::published(), LookedUp{});
  static const RobotVariables extended(VariableCatalog::extended(), LookedUp{});
  *this = &catalog == &VariableCatalog::published()  ? published
          : &catalog == &VariableCatalog::extended() ? extended
                                                     : RobotVariables(catalog, LookedUp{});
}

RobotVariables::RobotVariables(const VariableCatalog& catalog, LookedUp /*look*/) {
  Resolver names{catalog, missing};
  decisionActionA = names.intVar("DECISION_ACTION_A");
  decisionActionB = names.intVar("DECISION_ACTION_B");
  decisionSearchOn = names.intVar("DECISION_SEARCH_ON");
  decisionActionVision = names.intVar("DECISION_ACTION_VISION");
  decisionLocalization = names.intVar("DECISION_LOCALIZATION");
  imuReset = names.intVar("IMU_RESET");
  imuState = names.intVar("IMU_STATE");
  controlAction = names.intVar("CONTROL_ACTION");
  controlMoving = names.intVar("CONTROL_MOVING");
  voltage = names.intVar("VOLTAGE");
  visionLost = names.intVar("VISION_LOST");
  controlWorking = names.intVar("CONTROL_WORKING");
  visionWorking = names.intVar("VISION_WORKING");
  localizationWorking = names.intVar("LOCALIZATION_WORKING");
  decisionWorking = names.intVar("DECISION_WORKING");
  imuWorking = names.intVar("IMU_WORKING");
  comReferee = names.intVar("COM_REFEREE");
  localizationX = names.intVar("LOCALIZATION_X");
  localizationY = names.intVar("LOCALIZATION_Y");
  localizationTheta = names.intVar("LOCALIZATION_THETA");
  robotNumber = names.intVar("ROBOT_NUMBER");

  imuEulerX = names.floatVar("IMU_EULER_X");
  imuEulerY = names.floatVar("IMU_EULER_Y");
  imuEulerZ = names.floatVar("IMU_EULER_Z");
  imuGyroX = names.floatVar("IMU_GYRO_X");
  imuGyroY = names.floatVar("IMU_GYRO_Y");
  imuGyroZ = names.floatVar("IMU_GYRO_Z");
  imuAccelX = names.floatVar("IMU_ACCEL_X");
  imuAccelY = names.floatVar("IMU_ACCEL_Y");
  imuAccelZ = names.floatVar("IMU_ACCEL_Z");
  visionBallDist = names.floatVar("VISION_BALL_DIST");
  visionBallAngle = names.floatVar("VISION_BALL_ANGLE");
  visionPanDeg = names.floatVar("VISION_PAN_DEG");
  visionTiltDeg = names.floatVar("VISION_TILT_DEG");
  // The published localization publishes its belief under this name (system.md section 5).
  localizationBelief = names.floatVar("LOCALIZATION_RBT01_X");
  landmarkDeg = {
      names.floatVar("VISION_BLUE_LANDMARK_DEG"), names.floatVar("VISION_RED_LANDMARK_DEG"),
      names.floatVar("VISION_YELLOW_LANDMARK_DEG"), names.floatVar("VISION_PURPLE_LANDMARK_DEG")};
  for (std::size_t robot = 0; robot < robotDist.size(); ++robot) {
    char name[32];
    constexpr std::size_t published = 11;
    const auto floatVar = [&](const char* wanted) {
      if (robot < published) return names.floatVar(wanted);
      return catalog.floatVar(wanted).value_or(FloatVar{-1});
    };
    std::snprintf(name, sizeof name, "VISION_RBT%02d_DIST", static_cast<int>(robot) + 1);
    robotDist[robot] = floatVar(name);
    std::snprintf(name, sizeof name, "VISION_RBT%02d_ANGLE", static_cast<int>(robot) + 1);
    robotAngle[robot] = floatVar(name);
  }
}

}  // namespace pitchboard::link
