// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The numbers of a robot model that how it moves and what it perceives tell together: they are
// estimated in one likelihood (motion_filter.h). All are positive; the estimator works on their
// logarithms. Private to calibrate.

#include <array>
#include <cmath>
#include <cstddef>
#include <set>

#include <simcore/world/robot_model.h>

namespace pitchboard::link {

/// Log-normal prior: its median is the base model's number.
inline constexpr double speedPrior = 0.35;  ///< of the logarithm: 0.7 to 1.4 times within one sigma
inline constexpr double sigmaPrior = 0.7;   ///< of standard deviations: half to twice
inline constexpr double viewPrior = 0.25;   ///< field of view, range
/// A Beta prior of a probability has the base model's mean and counts as much as so many trials.
inline constexpr double ratePrior = 8.0;

struct MotionParameter {
  const char* key;  ///< as in robot files; numbers of noise with "noise." before
  double sim::RobotModel::*model;
  double sim::NoiseParameters::*noise;
  double prior;  ///< standard deviation of the logarithm
  double least;  ///< the prior's median where the base model has 0
};

enum : std::size_t {
  motionForwardFast,
  motionForwardSlow,
  motionBackwardFast,
  motionBackwardSlow,
  motionSideways,
  motionTurn,
  motionAroundSideways,
  motionAroundTurn,
  motionAcceleration,
  motionYawAcceleration,
  motionNoiseForward,
  motionNoiseSideways,
  motionNoiseRotation,
  motionBallDistance,
  motionBallBearing,
  motionLandmark,
  motionImuWhite,
  motionImuDrift,
  motionParameterCount
};

// clang-format off
inline constexpr std::array<MotionParameter, motionParameterCount> motionParameters{{
    {"forward_fast", &sim::RobotModel::forwardFast, nullptr, speedPrior, 0.1},
    {"forward_slow", &sim::RobotModel::forwardSlow, nullptr, speedPrior, 0.1},
    {"backward_fast", &sim::RobotModel::backwardFast, nullptr, speedPrior, 0.1},
    {"backward_slow", &sim::RobotModel::backwardSlow, nullptr, speedPrior, 0.1},
    {"sideways", &sim::RobotModel::sideways, nullptr, speedPrior, 0.1},
    {"turn", &sim::RobotModel::turn, nullptr, speedPrior, 0.3},
    {"around_sideways", &sim::RobotModel::aroundSideways, nullptr, speedPrior, 0.1},
    {"around_turn", &sim::RobotModel::aroundTurn, nullptr, speedPrior, 0.3},
    {"max_acceleration", &sim::RobotModel::maxAcceleration, nullptr, speedPrior, 0.2},
    {"max_yaw_acceleration", &sim::RobotModel::maxYawAcceleration, nullptr, speedPrior, 2.0},
    {"noise.forward", nullptr, &sim::NoiseParameters::forward, sigmaPrior, 0.0005},
    {"noise.sideways", nullptr, &sim::NoiseParameters::sideways, sigmaPrior, 0.0005},
    {"noise.rotation", nullptr, &sim::NoiseParameters::rotation, sigmaPrior, 0.001},
    {"noise.vision_distance", nullptr, &sim::NoiseParameters::visionDistance, sigmaPrior, 0.02},
    {"noise.vision_bearing", nullptr, &sim::NoiseParameters::visionBearing, sigmaPrior, 0.01},
    {"noise.landmark_bearing", nullptr, &sim::NoiseParameters::landmarkBearing, sigmaPrior, 0.01},
    {"noise.imu_white", nullptr, &sim::NoiseParameters::imuWhite, sigmaPrior, 0.001},
    {"noise.imu_drift", nullptr, &sim::NoiseParameters::imuDrift, sigmaPrior, 0.0001},
}};
// clang-format on

/// The actions that a number of the gait belongs to; none for noise.
inline std::set<int> actionsOf(std::size_t parameter) {
  switch (parameter) {
    case motionForwardFast:
      return {1};
    case motionForwardSlow:
      return {8};
    case motionBackwardFast:
      return {17};
    case motionBackwardSlow:
      return {18};
    case motionSideways:
      return {6, 7};
    case motionTurn:
      return {2, 3};
    case motionAroundSideways:
    case motionAroundTurn:
      return {9, 14};
    case motionAcceleration:
      return {1, 6, 7, 8, 9, 14, 17, 18};
    case motionYawAcceleration:
      return {2, 3, 9, 14};
    default:
      return {};
  }
}

/// Logarithms, in the order of the table.
using MotionLogs = std::array<double, motionParameterCount>;

inline double& valueOf(sim::RobotModel& model, const MotionParameter& parameter) {
  return parameter.model != nullptr ? model.*parameter.model : model.noise.*parameter.noise;
}
inline double valueOf(const sim::RobotModel& model, const MotionParameter& parameter) {
  return parameter.model != nullptr ? model.*parameter.model : model.noise.*parameter.noise;
}

/// Medians of the prior.
inline MotionLogs motionPrior(const sim::RobotModel& base) {
  MotionLogs out{};
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double value = valueOf(base, motionParameters[i]);
    out[i] = std::log(value > 0.0 ? value : motionParameters[i].least);
  }
  return out;
}

inline void setMotion(sim::RobotModel& model, const MotionLogs& logs) {
  for (std::size_t i = 0; i < logs.size(); ++i) {
    valueOf(model, motionParameters[i]) = std::exp(logs[i]);
  }
}

}  // namespace pitchboard::link
