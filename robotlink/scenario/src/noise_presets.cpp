// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>

#include <resources/resources.h>

#include "scenario_keys.h"

namespace pitchboard::link {
namespace {

// In the order in which people see them; each is resources/noise/<name>.json.
constexpr std::array<std::string_view, 4> names{"none", "published", "paper", "realistic"};

}  // namespace

std::vector<std::string> noisePresets() {
  return {names.begin(), names.end()};
}

Result<sim::NoiseParameters> noisePreset(std::string_view name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    return failure(ErrorCode::NotFound, unknownName("noise preset", name, names));
  }
  const std::string path = "noise/" + std::string(name) + ".json";
  JsonReport report(path);
  const auto root = parseJson(resourceText(path), report);
  sim::NoiseParameters noise;
  if (root) {
    const auto keys = sim::withKeys({"name", "title", "description"}, sim::noiseParameters);
    sim::readNumbers(JsonObject(report, *root, "", keys), sim::noiseParameters, noise);
  }
  if (report.failed()) return tl::unexpected(report.error());
  return noise;
}

}  // namespace pitchboard::link
