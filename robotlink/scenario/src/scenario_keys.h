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

/// Degrees that radiansFromDegrees() turns into exactly `radians` where such a double exists (the
/// shortest to write), else the nearest.
double fileDegrees(double radians);

}  // namespace pitchboard::link
