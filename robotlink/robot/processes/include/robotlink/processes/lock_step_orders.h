// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a match tells a separate reference process besides the messages of its team: a message of
// its own at the start of a cycle (LockStepSlots::startCycle()). Constants; any thread.

#include <string_view>

namespace pitchboard::link {

/// The process forgets everything and begins with what stands on the blackboard, because somebody
/// else has moved the robot. No message of a team begins with @.
inline constexpr std::string_view beginAnewOrder = "@begin anew";

}  // namespace pitchboard::link
