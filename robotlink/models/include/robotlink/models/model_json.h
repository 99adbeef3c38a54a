// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Writes numbers, noise and robot models as JSON that people read: only what differs from a
// built-in one, degrees for radians. Any thread.

#include <array>
#include <nlohmann/json.hpp>

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

/// What differs from `base`, by key.
template <class Values, class Number, std::size_t N>
nlohmann::ordered_json differences(const std::array<sim::Parameter<Values, Number>, N>& parameters,
                                   const Values& value, const Values& base) {
  nlohmann::ordered_json out = nlohmann::ordered_json::object();
  for (const auto& p : parameters) {
    const Number stored = value.*p.member;
    if (stored == base.*p.member) continue;
    out[p.key] = jsonNumber(p.unit.angle ? fileDegrees(stored) : stored);
  }
  return out;
}

}  // namespace pitchboard::link
