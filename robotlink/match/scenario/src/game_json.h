// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads and writes the "game" of a scenario file, and what its robots' objects say of it. Private
// to robotlink/scenario.

#include <optional>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <base/lined_json.h>
#include <robotlink/scenario/scenario.h>

namespace pitchboard::link {

/// The keys of a robot's object that are about the game.
inline constexpr std::string_view robotGameKeys[] = {"penalty", "cards", "goalkeeper"};

/// Nothing when the file has no "game" and no robot says anything of one. `root`: the scenario's
/// object; the robots of `scenario` are those of `robots`, in this order.
std::optional<sim::GameStart> readGameStart(JsonReport& report, const JsonObject& root,
                                            const std::vector<JsonObject>& robots,
                                            const Scenario& scenario);

nlohmann::ordered_json gameStartToJson(const sim::GameStart& game, const Scenario& scenario);
/// Into the object of the robot.
void addGameOf(const sim::GameStart& game, RobotId robot, nlohmann::ordered_json& out);

}  // namespace pitchboard::link
