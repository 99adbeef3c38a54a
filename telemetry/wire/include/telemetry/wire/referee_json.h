// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The referee's packets as JSON, with the names that docs/live.md lists: what `listen` and `decode`
// print and what a session keeps.

#include <nlohmann/json_fwd.hpp>

#include <telemetry/wire/gamecontroller.h>

namespace pitchboard::telemetry {

/// One object. Codes stand beside their words (state and stateName); what a version does not have
/// is left out. Texts may hold any bytes: dump with error_handler_t::replace.
nlohmann::ordered_json refereeJson(const RefereePacket& packet);

}  // namespace pitchboard::telemetry
