// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads and writes fields as people write them: the name of a built-in field, or an object as in
// scenario files (docs/scenarios.md). Pure functions; any thread.

#include <string>
#include <string_view>
#include <vector>

#include <base/lined_json.h>
#include <simcore/world/field.h>

namespace pitchboard::sim {

/// Returns the names of the built-in fields.
std::vector<std::string_view> fieldNames();

/// Reads an object as under "field" in a scenario file; errors go to `report`.
FieldSpec readField(JsonReport& report, const JsonNode& node, const std::string& path);

/// Reads a built-in name or an object. Errors name `source`.
Result<FieldSpec> fieldFromText(std::string_view nameOrJson, std::string_view source);
/// Returns the name of a built-in field, or else an object on one line; it reads back to an equal
/// field.
std::string fieldToText(const FieldSpec& field);

}  // namespace pitchboard::sim
