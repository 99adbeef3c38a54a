// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/calibrate/calibration_file.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include <base/angles.h>
#include <robotlink/models/model_json.h>
#include <simcore/world/parameters.h>

namespace pitchboard::link {
namespace {

using Json = nlohmann::ordered_json;

/// Five digits; more would suggest an accuracy that the fit does not have.
Json rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", value);
  return jsonNumber(std::strtod(text, nullptr));
}

const sim::ParameterUnit* unitOf(const std::string& key) {
  const auto find = [](const auto& parameters,
                       const std::string& name) -> const sim::ParameterUnit* {
    for (const auto& parameter : parameters) {
      if (name == parameter.key) return &parameter.unit;
    }
    return nullptr;
  };
  const auto contains = [&key](const char* part) { return key.find(part) != std::string::npos; };
  if (contains(": time to")) return &sim::units::seconds;
  if (contains("turn: spread")) return &sim::units::degreesPerSecond;
  if (contains(": spread")) return &sim::units::metresPerSecond;
  if (key == "field.rolling_deceleration") return &sim::units::metresPerSecondSquared;
  if (key.starts_with("noise.")) return find(sim::noiseParameters, key.substr(6));
  return find(sim::robotModelParameters, key);
}

Json toJson(const CalibratedValue& value) {
  const WrittenValue written = writtenValue(value);
  Json out{{"value", rounded(written.value)},
           {"low", rounded(written.low)},
           {"high", rounded(written.high)},
           {"samples", value.samples},
           {"of", value.of}};
  if (!written.unit.empty()) out["unit"] = written.unit;
  return out;
}

}  // namespace

WrittenValue writtenValue(const CalibratedValue& value) {
  const sim::ParameterUnit* unit = unitOf(value.key);
  WrittenValue out{value.value, value.low, value.high, unit != nullptr ? unit->symbol : ""};
  if (unit == nullptr || !unit->angle) return out;
  for (double* one : {&out.value, &out.low, &out.high}) *one = degreesFromRadians(*one);
  return out;
}

std::optional<double> writtenBase(const Calibration& calibration, std::string_view key) {
  const auto find = [](const auto& parameters, const auto& numbers,
                       std::string_view name) -> std::optional<double> {
    for (const auto& parameter : parameters) {
      if (name == parameter.key) return parameter.written(numbers.*parameter.member);
    }
    return {};
  };
  return key.starts_with("noise.")
             ? find(sim::noiseParameters, calibration.base.noise, key.substr(6))
             : find(sim::robotModelParameters, calibration.base, key);
}

std::string calibrationToJson(const Calibration& calibration, std::string_view program) {
  Json file = robotModelToJson(calibration.model);
  if (file.is_string()) file = Json{{"name", calibration.model.name}, {"base", file}};
  std::string sessions;
  for (const std::string& name : calibration.sessions) {
    sessions += (sessions.empty() ? "" : ", ") + name;
  }
  Json sources = Json::object();
  Json record{{"version", 1},
              {"program", program},
              {"sessions", calibration.sessions},
              {"seconds", rounded(calibration.seconds)},
              {"robot", calibration.robot},
              {"prior", calibration.base.name}};
  record["values"] = Json::object();
  for (const CalibratedValue& value : calibration.values) {
    record["values"][value.key] = toJson(value);
    if (value.key.starts_with("field.")) continue;
    const std::string key = value.key.starts_with("noise.") ? "noise" : value.key;
    sources[key] = "calibrated from " + sessions.substr(0, 1500);
    if (key != "noise") {
      sources[key] =
          sources[key].get<std::string>() + ", " + std::to_string(value.samples) + ' ' + value.of;
    }
  }
  record["kept"] = calibration.kept;
  record["derived"] = Json::object();
  for (const CalibratedValue& value : calibration.estimates)
    record["derived"][value.key] = toJson(value);
  record["left_out_s"] = Json::object();
  for (const auto& [cause, leftOut] : calibration.leftOut) {
    record["left_out_s"][cause] = rounded(leftOut.seconds);
  }
  record["notes"] = calibration.notes;
  const CalibrationCheck& check = calibration.check;
  record["check"] = {{"window_s", check.window},
                     {"windows", check.windows.size()},
                     {"rms_m", rounded(check.rms)},
                     {"rms_base_m", rounded(check.rmsBase)}};
  file["sources"] = sources;
  file["calibration"] = record;
  return file.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

Result<void> writeCalibration(const std::string& path, const Calibration& calibration,
                              std::string_view program, IfExists ifExists) {
  return writeFile(path, calibrationToJson(calibration, program), ifExists);
}

}  // namespace pitchboard::link
