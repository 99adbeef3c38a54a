// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads noise presets, which are data (resources/noise): none, published, paper, realistic, and
// robot (that of each robot's model). Angles are degrees in files, radians in memory. Any thread.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/lined_json.h>
#include <base/result.h>
#include <simcore/world/noise.h>

namespace pitchboard::link {

std::vector<std::string> noisePresets();
Result<sim::NoiseParameters> noisePreset(std::string_view name);

/// Reads noise as the name of a preset or an object; nothing if the key is missing.
std::optional<sim::NoiseParameters> readNoise(const JsonObject& parent, JsonReport& report,
                                              std::string_view key);

/// The key that says that each robot has the noise of its model.
inline constexpr std::string_view noiseOfModelKey = "of_model";

}  // namespace pitchboard::link
