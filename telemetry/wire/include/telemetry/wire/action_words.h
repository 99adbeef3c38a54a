// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// DECISION_ACTION_A in words (SYSTEM.md section 3).

#include <cstdint>
#include <map>
#include <string>

namespace pitchboard::telemetry {

/// "walk forward", "kick left (weak)", ...; "action 23" for a code that is not in the table.
std::string actionWords(int code);

/// The whole table: the labels of an action's column.
std::map<std::int32_t, std::string> actionLabels();

}  // namespace pitchboard::telemetry
