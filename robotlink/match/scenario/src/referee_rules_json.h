// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads and writes a referee's rules as part of a scenario file. Private to robotlink/scenario.

#include <optional>

#include <base/lined_json.h>
#include <simcore/world/referee_rules.h>

namespace pitchboard::link {

/// The value of "referee": a name or an object. Complaints go to `report`.
std::optional<sim::RefereeRules> readReferee(JsonReport& report, const JsonObject& parent,
                                             std::string_view key);

}  // namespace pitchboard::link
