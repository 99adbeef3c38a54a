// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/models/model_json.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include <base/angles.h>
#include <robotlink/models/noise_presets.h>
#include <robotlink/models/robot_models.h>

namespace pitchboard::link {
namespace {

using Json = nlohmann::ordered_json;

Json differencesOf(const sim::RobotModel& model, const sim::RobotModel& base) {
  Json out = numbersToJson(differences(sim::robotModelParameters, model, base));
  if (model.kickLaw != base.kickLaw) {
    out["kick_law"] = sim::kickLawNames[static_cast<std::size_t>(model.kickLaw)];
  }
  if (model.fromCamera != base.fromCamera) {
    out["distance_from"] = sim::distanceFromNames[model.fromCamera ? 1 : 0];
  }
  if (!(model.noise == base.noise)) out["noise"] = noiseToJson(model.noise);
  return out;
}

}  // namespace

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

Json jsonNumber(double value) {
  constexpr double exact = 9007199254740992.0;  // 2^53
  if (value > -exact && value < exact) {
    const auto whole = static_cast<std::int64_t>(value);
    if (static_cast<double>(whole) == value && !(value == 0.0 && std::signbit(value))) return whole;
  }
  return value;
}

Json numbersToJson(const KeyedNumbers& numbers) {
  Json out = Json::object();
  for (const auto& [key, number] : numbers) out[std::string(key)] = jsonNumber(number);
  return out;
}

Json noiseToJson(const sim::NoiseParameters& noise) {
  std::string base;
  Json least;
  for (const std::string& name : noisePresets()) {
    const auto preset = noisePreset(name);
    if (!preset) continue;
    if (*preset == noise) return name;
    Json changed = numbersToJson(differences(sim::noiseParameters, noise, *preset));
    if (noise.ofModel != preset->ofModel) changed[std::string(noiseOfModelKey)] = noise.ofModel;
    if (base.empty() || changed.size() < least.size()) {
      base = name;
      least = std::move(changed);
    }
  }
  Json out{{"preset", base}};
  out.update(least);
  return out;
}

Json robotModelToJson(const sim::RobotModel& model) {
  std::string base;
  Json least;
  for (const std::string& name : robotModels()) {
    const auto built = robotModelFromText(name, "");
    if (!built) continue;
    if (*built == model) return name;
    Json changed = differencesOf(model, *built);
    if (base.empty() || changed.size() < least.size()) {
      base = name;
      least = std::move(changed);
    }
  }
  Json out{{"name", model.name}, {"base", base}};
  out.update(least);
  return out;
}

std::string robotModelToText(const sim::RobotModel& model) {
  const Json json = robotModelToJson(model);
  return json.is_string() ? json.get<std::string>()
                          : json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace pitchboard::link
