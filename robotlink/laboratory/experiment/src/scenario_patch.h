// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Puts a value at a key of a scenario's JSON: "noise.forward", "robots[0].x", "robots[B1].model",
// "robots[*].behaviour", "writes[2].value". A name that stands for an object (a preset, a base)
// becomes that object. Pure; any thread.

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include <base/lined_json.h>
#include <base/result.h>

namespace pitchboard::link {

using Json = nlohmann::ordered_json;

Json jsonOf(const JsonNode& node);

/// Fails with a sentence that names what is not there.
Result<void> putValue(Json& scenario, std::string_view key, const Json& value);

}  // namespace pitchboard::link
