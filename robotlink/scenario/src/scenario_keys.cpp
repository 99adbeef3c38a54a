// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenario_keys.h"

#include <array>
#include <charconv>
#include <cmath>

#include <base/angles.h>

namespace pitchboard::link {
namespace {

constexpr std::string_view perFrameMetres = "metres per 1/60 s";
constexpr std::string_view perFrameDegrees = "degrees per 1/60 s";

}  // namespace

std::span<const NumberKey<sim::NoiseParameters>> noiseKeys() {
  using N = sim::NoiseParameters;
  static constexpr std::array<NumberKey<N>, 15> keys{{
      {"forward", &N::forward, {0, 1, perFrameMetres}},
      {"sideways", &N::sideways, {0, 1, perFrameMetres}},
      {"rotation", &N::rotation, {0, 180, perFrameDegrees}},
      {"kick_speed", &N::kickSpeed, {0, 20, "metres per second"}},
      {"kick_angle", &N::kickAngle, {0, 180, inDegrees}},
      {"vision_distance", &N::visionDistance, {0, 1, {}}},
      {"vision_bearing", &N::visionBearing, {0, 180, inDegrees}},
      {"robot_distance", &N::robotDistance, {0, 10, inMetres}},
      {"robot_bearing", &N::robotBearing, {0, 180, inDegrees}},
      {"landmark_bearing", &N::landmarkBearing, {0, 180, inDegrees}},
      {"landmark_probability", &N::landmarkProbability, {0, 1, {}}},
      {"missed_detection", &N::missedDetection, {0, 1, {}}},
      {"vision_delay", &N::visionDelay, {0, 2, "seconds"}},
      {"imu_white", &N::imuWhite, {0, 180, inDegrees}},
      {"imu_drift", &N::imuDrift, {0, 180, perFrameDegrees}},
  }};
  return keys;
}

std::span<const NumberKey<sim::FieldSpec>> fieldKeys() {
  using F = sim::FieldSpec;
  static constexpr std::array<NumberKey<F>, 16> keys{{
      {"length", &F::length, {1, 200, inMetres}},
      {"width", &F::width, {1, 200, inMetres}},
      {"border", &F::border, {0.1, 20, inMetres}},
      {"goal_width", &F::goalWidth, {0.2, 100, inMetres}},
      {"goal_depth", &F::goalDepth, {0.1, 20, inMetres}},
      {"goal_height", &F::goalHeight, {0, 20, inMetres}},
      {"goal_post_radius", &F::goalPostRadius, {0.005, 1, inMetres}},
      {"goal_area_length", &F::goalAreaLength, {0, 100, inMetres}},
      {"goal_area_width", &F::goalAreaWidth, {0, 200, inMetres}},
      {"penalty_area_length", &F::penaltyAreaLength, {0, 100, inMetres}},
      {"penalty_area_width", &F::penaltyAreaWidth, {0, 200, inMetres}},
      {"penalty_mark_distance", &F::penaltyMarkDistance, {0, 100, inMetres}},
      {"centre_circle_diameter", &F::centreCircleDiameter, {0, 100, inMetres}},
      {"line_width", &F::lineWidth, {0.001, 1, inMetres}},
      {"ball_radius", &F::ballRadius, {0.01, 0.5, inMetres}},
      {"robot_radius", &F::robotRadius, {0.02, 1, inMetres}},
  }};
  return keys;
}

std::span<const NumberKey<sim::RigidBodySettings>> rigidBodyKeys() {
  using R = sim::RigidBodySettings;
  static constexpr std::array<NumberKey<R>, 13> keys{{
      {"max_acceleration", &R::maxAcceleration, {0.01, 1000, "metres per second squared"}},
      {"max_yaw_acceleration", &R::maxYawAcceleration, {1, 500000, "degrees per second squared"}},
      {"robot_mass", &R::robotMass, {0.1, 200, "kilograms"}},
      {"ball_mass", &R::ballMass, {0.01, 5, "kilograms"}},
      {"ball_friction", &R::ballFriction, {0, 1, {}}},
      {"post_restitution", &R::postRestitution, {0, 1, {}}},
      {"robot_restitution", &R::robotRestitution, {0, 1, {}}},
      {"fall_impulse", &R::fallImpulse, {0, 1000, "newton seconds"}},
      {"get_up_time", &R::getUpTime, {0, 600, "seconds"}},
      {"head_speed", &R::headSpeed, {0, 5000, "degrees per second"}},
      {"field_of_view", &R::fieldOfView, {1, 360, inDegrees}},
      {"pan_limit", &R::panLimit, {0, 180, inDegrees}},
      {"vision_range", &R::visionRange, {0, 100, inMetres}},
  }};
  return keys;
}

double fileDegrees(double radians) {
  const double quotient = degreesFromRadians(radians);
  double best = quotient;
  // Two roundings lie between the two forms, so the right one may be a neighbour.
  for (const double candidate :
       {quotient, std::nextafter(quotient, -1e300), std::nextafter(quotient, 1e300)}) {
    if (radiansFromDegrees(candidate) == radians) {
      best = candidate;
      break;
    }
  }
  const double target = radiansFromDegrees(best);
  for (int digits = 1; digits < 17; ++digits) {
    std::array<char, 40> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), best,
                                   std::chars_format::general, digits);
    double candidate = best;
    std::from_chars(text.data(), end.ptr, candidate);
    if (radiansFromDegrees(candidate) == target) return candidate;
  }
  return best;
}

void readNoiseKeys(const JsonObject& object, sim::NoiseParameters& noise) {
  for (const auto& key : noiseKeys()) {
    if (!object.find(key.key)) continue;
    const double value = object.number(key.key, 0.0, key.range);
    noise.*key.member = key.angle() ? radiansFromDegrees(value) : value;
  }
}

}  // namespace pitchboard::link
