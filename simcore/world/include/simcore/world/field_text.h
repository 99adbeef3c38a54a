// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A field as people write it: the name of a built-in one, or an object of scenario files
// (docs/scenarios.md). Any thread.

#include <string>
#include <string_view>
#include <vector>

#include <base/lined_json.h>
#include <simcore/world/field.h>

namespace pitchboard::sim {

/// Names of the built-in fields, in their order.
std::vector<std::string_view> fieldNames();

/// The object that "field" has in a scenario file; complaints go to `report`.
FieldSpec readField(JsonReport& report, const JsonNode& node, const std::string& path);

/// A built-in name or an object. Errors name `source`.
Result<FieldSpec> fieldFromText(std::string_view nameOrJson, std::string_view source);
/// The name of a built-in field, else an object on one line; reading it gives an equal field.
std::string fieldToText(const FieldSpec& field);

}  // namespace pitchboard::sim
