// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The facts about a group as text: in session files, in `inspect --json`, and for people. Names are
// listed in docs/file-formats.md. Pure functions; any thread.

#include <map>
#include <string>

#include <telemetry/series/series_types.h>

namespace pitchboard::telemetry {

/// Name and value of every fact that is known.
using GroupAttributes = std::map<std::string, std::string>;

GroupAttributes attributesOf(const GroupInfo& group);
/// Sets the facts of the group; unknown names, and values that cannot be, are left out.
void readAttributes(const GroupAttributes& attributes, GroupInfo& group);

}  // namespace pitchboard::telemetry
