// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// DECISION_ACTION_A in words (SYSTEM.md section 3).

#include <string>

namespace pitchboard::telemetry {

/// "walk forward", "kick left (weak)", ...; "action 23" for a code that is not in the table.
std::string actionWords(int code);

}  // namespace pitchboard::telemetry
