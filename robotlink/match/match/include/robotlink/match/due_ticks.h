// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// When what has a time in seconds is due in a match of ticks. Pure functions; any thread.

#include <cstdint>

namespace pitchboard::link {

/// Returns the first tick at or after this time; one that is a whole number of ticks but for
/// rounding belongs to that tick.
std::uint64_t firstTickAtOrAfter(double seconds, double tickRate);
/// Returns the first tick after `after` at which a multiple of `period` seconds has passed: then a
/// process with this period runs its next cycle.
std::uint64_t nextDueTick(double period, std::uint64_t after, double tickRate);

}  // namespace pitchboard::link
