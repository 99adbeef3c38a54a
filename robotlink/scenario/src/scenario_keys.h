// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the reader and the writer of scenario files have in common. The numbers they read are those
// of simcore/world/parameters.h: degrees in files, radians in memory. Private to robotlink.

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
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

/// In noise: the numbers are those of each robot's model.
inline constexpr std::string_view ofModelKey = "of_model";

/// Noise as a preset's name or an object; nothing when the key is missing.
std::optional<sim::NoiseParameters> readNoise(const JsonObject& parent, JsonReport& report,
                                              std::string_view key);

/// A model as the object of a scenario or of a file.
sim::RobotModel readRobotModelObject(JsonReport& report, const JsonNode& node,
                                     const std::string& path);
/// A model as a built-in name or such an object; nothing when the key is missing.
std::optional<sim::RobotModel> readRobotModel(const JsonObject& parent, JsonReport& report,
                                              std::string_view key);

/// The form in which whole numbers have no decimal point, as people write them.
nlohmann::ordered_json jsonNumber(double value);
nlohmann::ordered_json noiseToJson(const sim::NoiseParameters& noise);
nlohmann::ordered_json robotModelToJson(const sim::RobotModel& model);

/// Names of the values of sim::AfterGoal, in its order.
inline constexpr std::array<std::string_view, 2> afterGoalNames{"stop_clock", "centre_ball"};

/// Of the form of scenario files; the only one so far.
constexpr int scenarioVersion = 1;

/// Degrees that radiansFromDegrees() turns into exactly `radians` where such a double exists (the
/// shortest to write), else the nearest.
double fileDegrees(double radians);

/// What differs from `base`, by key.
template <class Values, std::size_t N>
nlohmann::ordered_json differences(const std::array<sim::Parameter<Values>, N>& parameters,
                                   const Values& value, const Values& base) {
  nlohmann::ordered_json out = nlohmann::ordered_json::object();
  for (const auto& p : parameters) {
    const double stored = value.*p.member;
    if (stored == base.*p.member) continue;
    out[p.key] = jsonNumber(p.unit.angle ? fileDegrees(stored) : stored);
  }
  return out;
}

}  // namespace pitchboard::link
