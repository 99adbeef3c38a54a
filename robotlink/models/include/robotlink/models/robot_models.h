// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Kinds of robots are data (resources/robots): what a robot can do and how it sees, by name, as an
// object of a scenario file, or as a file (docs/robot-programs.md). Any thread.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/lined_json.h>
#include <base/result.h>
#include <simcore/world/robot_model.h>

namespace pitchboard::link {

/// The built-in names, "published" first.
std::vector<std::string> robotModels();
struct RobotModelText {
  std::string title;        ///< a few words, for choosers
  std::string description;  ///< which robot it is and where its numbers come from
};
/// What people read of a built-in model; its name when it has no title.
RobotModelText robotModelText(std::string_view name);
/// A built-in name, or the object that "model" has in a scenario file. Errors name `source`.
Result<sim::RobotModel> robotModelFromText(std::string_view nameOrJson, std::string_view source);
/// A built-in name, or else a file with such an object.
Result<sim::RobotModel> loadRobotModel(const std::string& nameOrPath);
/// The name of a built-in model, else an object on one line; reading it gives an equal model.
std::string robotModelToText(const sim::RobotModel& model);

/// A model as a built-in name or an object; nothing when the key is missing.
std::optional<sim::RobotModel> readRobotModel(const JsonObject& parent, JsonReport& report,
                                              std::string_view key);

}  // namespace pitchboard::link
