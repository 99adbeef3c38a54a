// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Finds the name that was meant by a mistyped one, for errors about files and command lines. Pure
// functions; any thread.

#include <span>
#include <string_view>

namespace pitchboard {

/// Returns the known name that is most similar to a mistyped or shortened one; empty if none is
/// similar.
std::string_view nearestName(std::string_view name, std::span<const std::string_view> known);

}  // namespace pitchboard
