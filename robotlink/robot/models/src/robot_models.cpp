// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/byte_sizes.h>
#include <robotlink/models/robot_models.h>

#include <algorithm>

#include <base/read_file.h>
#include <resources/resources.h>
#include <robotlink/models/noise_presets.h>
#include <simcore/world/parameter_reading.h>

namespace pitchboard::link {
namespace {

constexpr std::size_t maxNameLength = 64;
constexpr std::size_t longestText = 2000;
constexpr std::size_t maxFileBytes = 64 * kibibyte;

/// In the order in which people see them.
const std::vector<std::string_view>& modelNames() {
  static const auto all =
      resourceNames("robots", {"published", "darwin-op", "kid-size", "adult-size"});
  return all;
}

std::string pathOf(std::string_view name) {
  return "robots/" + std::string(name) + ".json";
}

sim::RobotModel readRobotModelObject(JsonReport& report, const JsonNode& node,
                                     const std::string& path);

Result<sim::RobotModel> modelFromJson(std::string_view text, std::string_view source) {
  JsonReport report(source);
  const auto root = parseJson(text, report, maxFileBytes);
  sim::RobotModel model;
  if (root) model = readRobotModelObject(report, *root, "");
  if (report.failed()) return tl::unexpected(report.error());
  return model;
}

/// Where each number is from, for people: any key of the model, and a text.
void checkSources(JsonReport& report, const JsonObject& model) {
  const JsonNode* node = model.find("sources");
  if (!node) return;
  const auto keys =
      sim::withKeys({"kick_law", "distance_from", "noise"}, sim::robotModelParameters);
  const JsonObject sources(report, *node, model.pathOf("sources"), keys);
  for (const std::string_view key : keys) (void)sources.text(key, "", longestText);
}

/// Checks how `pitchboard-cli calibrate` found the numbers (docs/calibrate.md); the model does not
/// contain it. Versions before 0.17 wrote "told" instead of "derived".
void checkCalibration(JsonReport& report, const JsonObject& model) {
  const JsonNode* node = model.find("calibration");
  if (!node) return;
  const JsonObject record(report, *node, model.pathOf("calibration"),
                          {"version", "program", "sessions", "seconds", "robot", "prior", "values",
                           "kept", "derived", "told", "left_out_s", "notes", "check"});
  (void)record.integer("version", 1, 1, 1);
  const JsonNode* values = record.find("values");
  if (!values) return;
  const JsonObject estimates(report, *values, record.pathOf("values"));
  for (const JsonMember& member : estimates.members()) {
    const JsonObject value(report, member.value, record.pathOf("values") + "." + member.key,
                           {"value", "low", "high", "samples", "of", "unit"});
    for (const char* key : {"value", "low", "high"}) value.require(key);
  }
}

sim::RobotModel readRobotModelObject(JsonReport& report, const JsonNode& node,
                                     const std::string& path) {
  const JsonObject object(report, node, path,
                          sim::withKeys({"name", "title", "description", "base", "kick_law",
                                         "distance_from", "noise", "sources", "calibration"},
                                        sim::robotModelParameters));
  sim::RobotModel model;
  if (const auto base = object.choice("base", modelNames(), "robot model")) {
    if (auto built = robotModelFromText(modelNames()[*base], "base")) model = *built;
  }
  model.name = object.text("name", "custom", maxNameLength);
  if (model.name.empty()) object.fail("name", "must not be empty");
  (void)object.text("title", "", longestText);
  (void)object.text("description", "", longestText);
  checkSources(report, object);
  checkCalibration(report, object);
  sim::readNumbers(object, sim::robotModelParameters, model);
  const auto choose = [&](std::string_view key, const auto& known, std::string_view what,
                          std::size_t now) {
    const std::vector<std::string_view> names(known.begin(), known.end());
    return object.choice(key, names, what).value_or(now);
  };
  model.kickLaw = static_cast<sim::KickLaw>(
      choose("kick_law", sim::kickLawNames, "kick law", static_cast<std::size_t>(model.kickLaw)));
  model.fromCamera = choose("distance_from", sim::distanceFromNames, "reference point",
                            model.fromCamera ? 1 : 0) == 1;
  if (const auto noise = readNoise(object, report, "noise")) model.noise = *noise;
  if (!(model.batteryEmpty < model.batteryLow && model.batteryLow < model.batteryFull)) {
    object.fail("battery_low", "must lie between battery_empty and battery_full");
  }
  if (report.failed()) return model;
  if (const auto valid = sim::validate(model); !valid) {
    const std::string key = valid.error().context.substr(valid.error().context.find('.') + 1);
    object.fail(key.substr(0, key.find('.')), valid.error().message);
  }
  return model;
}

}  // namespace

std::vector<std::string> robotModels() {
  return {modelNames().begin(), modelNames().end()};
}

std::optional<sim::RobotModel> readRobotModel(const JsonObject& parent, JsonReport& report,
                                              std::string_view key) {
  const JsonNode* node = parent.find(key);
  if (!node) return {};
  if (node->kind == JsonNode::Kind::Object) {
    return readRobotModelObject(report, *node, parent.pathOf(key));
  }
  if (node->kind != JsonNode::Kind::Text) {
    parent.fail(key, "must be the name of a robot model, in quotes, or an object in braces");
    return {};
  }
  if (node->text.find_first_of("/.") != std::string::npos) {
    auto loaded = loadRobotModel(node->text);
    if (loaded) return std::move(*loaded);
    parent.fail(key, loaded.error().text());
    return {};
  }
  const auto built = parent.choice(key, modelNames(), "robot model");
  if (!built) return {};
  const auto model = robotModelFromText(modelNames()[*built], "");
  return model ? std::optional<sim::RobotModel>(*model) : std::nullopt;
}

RobotModelText robotModelText(std::string_view name) {
  RobotModelText text{std::string(name), {}};
  if (std::ranges::find(modelNames(), name) == modelNames().end()) return text;
  JsonReport report(name);
  const auto root = parseJson(resourceText(pathOf(name)), report);
  if (!root) return text;
  const JsonObject object(report, *root, "");
  text.title = object.text("title", text.title, longestText);
  text.description = object.text("description", "", longestText);
  return text;
}

Result<sim::RobotModel> robotModelFromText(std::string_view nameOrJson, std::string_view source) {
  if (nameOrJson.find('{') != std::string_view::npos) return modelFromJson(nameOrJson, source);
  if (std::ranges::find(modelNames(), nameOrJson) != modelNames().end()) {
    return modelFromJson(resourceText(pathOf(nameOrJson)), pathOf(nameOrJson));
  }
  return failure(ErrorCode::NotFound, unknownName("robot model", nameOrJson, modelNames()),
                 std::string(source));
}

Result<sim::RobotModel> loadRobotModel(const std::string& nameOrPath) {
  if (std::ranges::find(modelNames(), nameOrPath) != modelNames().end()) {
    return robotModelFromText(nameOrPath, nameOrPath);
  }
  const auto text = readFile(nameOrPath, maxFileBytes, "the robot model");
  if (!text && text.error().code == ErrorCode::NotFound &&
      nameOrPath.find_first_of("/.") == std::string::npos) {
    return failure(ErrorCode::NotFound,
                   unknownName("built-in robot model and no file", nameOrPath, modelNames()));
  }
  if (!text) return tl::unexpected(text.error());
  return modelFromJson(*text, nameOrPath);
}

}  // namespace pitchboard::link
