// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string_view>

namespace pitchboard {

/// The known name that was probably meant by a mistyped one; empty when none is near.
std::string_view nearestName(std::string_view name, std::span<const std::string_view> known);

}  // namespace pitchboard
