// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The referee's packets as JSON, with the names that docs/live.md lists: `listen` and `decode`
// print them, and sessions store them. Pure functions; any thread.

#include <nlohmann/json_fwd.hpp>

#include <telemetry/referee/gamecontroller.h>

namespace pitchboard::telemetry {

/// Returns an object with codes and their names (state and stateName); fields that the version does
/// not have are left out. Texts may hold any bytes, so dump it with error_handler_t::replace.
nlohmann::ordered_json refereeJson(const RefereePacket& packet);

}  // namespace pitchboard::telemetry
