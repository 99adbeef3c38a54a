// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Noise presets are data (resources/noise): none, published, paper, realistic; robot: each robot
// has that of its model. Angles are degrees in files, radians in memory. Any thread.

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

/// Noise as a preset's name or an object; nothing when the key is missing.
std::optional<sim::NoiseParameters> readNoise(const JsonObject& parent, JsonReport& report,
                                              std::string_view key);

/// In noise: the numbers are those of each robot's model.
inline constexpr std::string_view noiseOfModelKey = "of_model";

}  // namespace pitchboard::link
