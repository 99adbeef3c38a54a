// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the reader and the writer of scenario files have in common. Private to robotlink.

#include <array>
#include <string_view>

#include <base/lined_json.h>
#include <robotlink/scenario/scenario.h>
#include <simcore/world/parameter_reading.h>

namespace pitchboard::link {

/// Names of the values of sim::AfterGoal, in its order.
inline constexpr std::array<std::string_view, 2> afterGoalNames{"stop_clock", "centre_ball"};

/// Of the form of scenario files; the only one so far.
constexpr int scenarioVersion = 1;

/// What earlier versions called a number, in "rigid_body": until 0.2 those of robots, until 0.8
/// those of the surface.
struct EarlierKey {
  std::string_view key;
  std::string_view now;
};
inline constexpr std::array<EarlierKey, 12> earlierKeys{
    {{"max_acceleration", "max_acceleration"},
     {"max_yaw_acceleration", "max_yaw_acceleration"},
     {"robot_mass", "mass"},
     {"fall_impulse", "fall_impulse"},
     {"get_up_time", "get_up_front"},
     {"get_up_time", "get_up_back"},
     {"head_speed", "head_speed"},
     {"field_of_view", "field_of_view"},
     {"pan_limit", "pan_limit"},
     {"vision_range", "vision_range"},
     {"ball_friction", "rolling_speed_kept"},
     {"ball_deceleration", "rolling_deceleration"}}};

}  // namespace pitchboard::link
