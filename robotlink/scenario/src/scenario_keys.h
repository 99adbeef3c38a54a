// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the reader and the writer of scenario files have in common. The numbers they read are those
// of simcore/world/parameters.h: degrees in files, radians in memory. Private to robotlink.

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include <base/lined_json.h>
#include <robotlink/scenario/scenario.h>
#include <simcore/world/parameters.h>

namespace pitchboard::link {

template <class Values>
NumberRange rangeOf(const sim::Parameter<Values>& parameter) {
  return {parameter.least, parameter.most, parameter.unit.words};
}

/// `keys`, and those of the parameters.
template <class Values, std::size_t N>
std::vector<std::string_view> withKeys(std::vector<std::string_view> keys,
                                       const std::array<sim::Parameter<Values>, N>& parameters) {
  for (const auto& parameter : parameters) keys.push_back(parameter.key);
  return keys;
}

/// Reads those parameters that the object has over `values`.
template <class Values, std::size_t N>
void readNumbers(const JsonObject& object, const std::array<sim::Parameter<Values>, N>& parameters,
                 Values& values) {
  for (const auto& parameter : parameters) {
    if (!object.find(parameter.key)) continue;
    const double written = object.number(parameter.key, 0.0, rangeOf(parameter));
    values.*parameter.member = parameter.stored(written);
  }
}

/// Names of the values of sim::AfterGoal, in its order.
inline constexpr std::array<std::string_view, 2> afterGoalNames{"stop_clock", "centre_ball"};

/// Of the form of scenario files; the only one so far.
constexpr int scenarioVersion = 1;

/// Degrees that radiansFromDegrees() turns into exactly `radians` where such a double exists (the
/// shortest to write), else the nearest.
double fileDegrees(double radians);

}  // namespace pitchboard::link
