// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Writes numbers, noise and robot models as JSON for people: only what differs from a built-in one,
// in degrees instead of radians. Pure functions; any thread.

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include <simcore/world/noise.h>
#include <simcore/world/parameters.h>
#include <simcore/world/robot_model.h>

namespace pitchboard::link {

/// Returns the shortest degrees that radiansFromDegrees() converts to exactly `radians`, or the
/// nearest if there are none.
double fileDegrees(double radians);

/// Returns a number as people write it: whole numbers without a decimal point.
nlohmann::ordered_json jsonNumber(double value);
nlohmann::ordered_json noiseToJson(const sim::NoiseParameters& noise);
nlohmann::ordered_json robotModelToJson(const sim::RobotModel& model);

/// Numbers by key, as they stand in a file.
using KeyedNumbers = std::vector<std::pair<std::string_view, double>>;
nlohmann::ordered_json numbersToJson(const KeyedNumbers& numbers);

/// Returns what differs from `base`.
template <class Values, class Number, std::size_t N>
KeyedNumbers differences(const std::array<sim::Parameter<Values, Number>, N>& parameters,
                         const Values& value, const Values& base) {
  KeyedNumbers out;
  for (const auto& p : parameters) {
    const Number stored = value.*p.member;
    if (stored == base.*p.member) continue;
    const double number = static_cast<double>(stored);
    out.emplace_back(p.key, p.unit.angle ? fileDegrees(number) : number);
  }
  return out;
}

}  // namespace pitchboard::link
