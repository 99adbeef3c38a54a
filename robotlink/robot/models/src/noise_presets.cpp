// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/models/noise_presets.h>

#include <algorithm>

#include <resources/resources.h>
#include <simcore/world/parameter_reading.h>

namespace pitchboard::link {
namespace {

/// In the order in which people see them.
const std::vector<std::string_view>& presetNames() {
  static const auto all =
      resourceNames("noise", {"none", "published", "paper", "realistic", "robot"});
  return all;
}

}  // namespace

std::vector<std::string> noisePresets() {
  return {presetNames().begin(), presetNames().end()};
}

Result<sim::NoiseParameters> noisePreset(std::string_view name) {
  if (std::ranges::find(presetNames(), name) == presetNames().end()) {
    return failure(ErrorCode::NotFound, unknownName("noise preset", name, presetNames()));
  }
  const std::string path = "noise/" + std::string(name) + ".json";
  JsonReport report(path);
  const auto root = parseJson(resourceText(path), report);
  sim::NoiseParameters noise;
  if (root) {
    const auto keys =
        sim::withKeys({"name", "title", "description", noiseOfModelKey}, sim::noiseParameters);
    const JsonObject object(report, *root, "", keys);
    noise.ofModel = object.boolean(noiseOfModelKey, false);
    sim::readNumbers(object, sim::noiseParameters, noise);
  }
  if (report.failed()) return tl::unexpected(report.error());
  return noise;
}

std::optional<sim::NoiseParameters> readNoise(const JsonObject& parent, JsonReport& report,
                                              std::string_view key) {
  const JsonNode* node = parent.find(key);
  if (!node) return {};
  sim::NoiseParameters noise;
  const auto take = [&](std::size_t index) {
    if (auto preset = noisePreset(presetNames()[index])) noise = *preset;
  };
  if (node->kind == JsonNode::Kind::Text) {
    if (const auto preset = parent.choice(key, presetNames(), "noise preset")) take(*preset);
    return noise;
  }
  if (node->kind != JsonNode::Kind::Object) {
    parent.fail(key, "must be the name of a noise preset, in quotes, or an object in braces");
    return noise;
  }
  const JsonObject object(report, *node, parent.pathOf(key),
                          sim::withKeys({"preset", noiseOfModelKey}, sim::noiseParameters));
  if (const auto preset = object.choice("preset", presetNames(), "noise preset")) take(*preset);
  noise.ofModel = object.boolean(noiseOfModelKey, noise.ofModel);
  sim::readNumbers(object, sim::noiseParameters, noise);
  return noise;
}

}  // namespace pitchboard::link
