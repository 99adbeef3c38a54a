// SPDX-License-Identifier: GPL-3.0-or-later
#include <simcore/world/robot_model.h>

#include <simcore/world/action.h>
#include <simcore/world/parameters.h>

#include "parameter_check.h"

namespace pitchboard::sim {

GaitSpeed gaitSpeed(const RobotModel& model, int action, int b) {
  constexpr int leastFixedB = 10;  // from here on action 8 walks at its full speed
  switch (action) {
    case 1:
      return {model.forwardFast, 0.0, 0.0, true};
    case 2:
      return {0.0, 0.0, model.turn, true};
    case 3:
      return {0.0, 0.0, -model.turn, true};
    case 6:
      return {0.0, model.sideways, 0.0, true};
    case 7:
      return {0.0, -model.sideways, 0.0, true};
    case 8:
      return {b < leastFixedB ? model.forwardSlow / leastFixedB * b : model.forwardSlow, 0.0, 0.0,
              true};
    case 9:
      return {0.0, model.aroundSideways, -model.aroundTurn, true};
    case 14:
      return {0.0, -model.aroundSideways, model.aroundTurn, true};
    case 17:
      return {-model.backwardFast, 0.0, 0.0, true};
    case 18:
      return {-model.backwardSlow, 0.0, 0.0, true};
    default:
      break;
  }
  const Action* entry = findAction(action);
  return {0.0, 0.0, 0.0, entry != nullptr && entry->kind == ActionKind::InPlace};
}

Result<void> validate(const RobotModel& model) {
  const auto refuse = [](const BadParameter& bad, const std::string& path) {
    return failure(ErrorCode::InvalidArgument, "This value " + bad.text + ".", path + bad.key);
  };
  if (const auto bad = firstBad<RobotModel>(model, robotModelParameters); !bad.key.empty()) {
    return refuse(bad, "robot_model.");
  }
  if (const auto bad = firstBad<NoiseParameters>(model.noise, noiseParameters); !bad.key.empty()) {
    return refuse(bad, "robot_model.noise.");
  }
  if (model.noise.ofModel) {
    return refuse({"noise", "must be numbers or a preset, and is \"robot\" itself"},
                  "robot_model.");
  }
  return {};
}

}  // namespace pitchboard::sim
