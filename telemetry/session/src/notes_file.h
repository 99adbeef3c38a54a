// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The file beside a recording that has its bookmarks, drawn notes and videos. Whoever changes a
// part of it keeps the rest. Any thread.

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include <base/result.h>

namespace pitchboard::telemetry {

/// Returns the whole file; an empty one if there is none. Fails as readSessionNotes() does.
Result<nlohmann::ordered_json> readNotesFile(const std::string& session);
/// Reads, changes and writes the file as one step, so that threads of this program do not lose what
/// another one wrote. Does not write if nothing changed.
Result<void> changeNotesFile(const std::string& session,
                             const std::function<void(nlohmann::ordered_json&)>& change);

}  // namespace pitchboard::telemetry
