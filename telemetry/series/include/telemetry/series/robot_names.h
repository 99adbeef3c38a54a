// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Resolves the names of robots that people type or that a layout contains. A name means the group
// that has it or, if none has it now, the robot that had it earlier: a referee corrects colours,
// and a setup gives robots other names. Pure functions; any thread.

#include <span>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <telemetry/series/series_types.h>

namespace pitchboard::telemetry {

/// Keeps the names of a group while it changes from `before` to `now`.
void keepFormerNames(const GroupInfo& before, GroupInfo& now);

/// Returns the groups of the robot that this name means, by their indices. Fails with NotFound and
/// the names that there are, or with InvalidArgument if several robots had the name.
Result<std::vector<GroupId>> groupsNamed(std::string_view name,
                                         std::span<const GroupInfo* const> groups);

}  // namespace pitchboard::telemetry
