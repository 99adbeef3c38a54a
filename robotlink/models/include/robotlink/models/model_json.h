// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Writes numbers, noise and robot models as JSON that people read: only what differs from a
// built-in one, degrees for radians. Any thread.

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include <simcore/world/noise.h>
#include <simcore/world/parameters.h>
#include <simcore/world/robot_model.h>

namespace pitchboard::link {

/// Degrees that radiansFromDegrees() turns into exactly `radians` where such a double exists (the
/// shortest to write), else the nearest.
double fileDegrees(double radians);

/// The form in which whole numbers have no decimal point, as people write them.
nlohmann::ordered_json jsonNumber(double value);
nlohmann::ordered_json noiseToJson(const sim::NoiseParameters& noise);
nlohmann::ordered_json robotModelToJson(const sim::RobotModel& model);

/// Numbers as they stand in a file, by key.
using KeyedNumbers = std::vector<std::pair<std::string_view, double>>;
nlohmann::ordered_json numbersToJson(const KeyedNumbers& numbers);

/// What differs from `base`.
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
