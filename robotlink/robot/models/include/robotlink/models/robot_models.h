// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads and writes robot models, which are data (resources/robots): by name, as an object of a
// scenario, or from a file (docs/scenarios.md, "Robot models"). Plain values; any thread.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/lined_json.h>
#include <base/result.h>
#include <simcore/world/robot_model.h>

namespace pitchboard::link {

/// Returns the built-in names, "published" first.
std::vector<std::string> robotModels();
struct RobotModelText {
  std::string title;        ///< a short title for lists
  std::string description;  ///< the real robot, and the source of its numbers
};
/// Returns the title of a built-in model, or its name if it has none.
RobotModelText robotModelText(std::string_view name);
/// Reads a built-in name, or an object as "model" of a scenario. Errors name `source`.
Result<sim::RobotModel> robotModelFromText(std::string_view nameOrJson, std::string_view source);
/// Reads a built-in name, or a file with such an object.
Result<sim::RobotModel> loadRobotModel(const std::string& nameOrPath);
/// Returns the name of a built-in model, or an object on one line; it reads back to an equal one.
std::string robotModelToText(const sim::RobotModel& model);

/// Reads a model as a built-in name, a file or an object; nothing if the key is missing.
std::optional<sim::RobotModel> readRobotModel(const JsonObject& parent, JsonReport& report,
                                              std::string_view key);

}  // namespace pitchboard::link
