// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where the RobotUids of live robots lie: those of simulated robots are below, those of uidOf()
// above. Constants; any thread.

#include <cstdint>

namespace pitchboard::link::uid_ranges {

inline constexpr std::uint32_t ofNetwork = 1U << 28, ofBoardKey = 2U << 28, mask = ofNetwork - 1;

}  // namespace pitchboard::link::uid_ranges
