// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The scenario that what is shown came from: that of the simulated match, or the one that a
// recorded session has attached. What starts from a moment takes over physics and noise from it. UI
// thread only.

#include <optional>

#include <robotlink/scenario/scenario.h>

namespace pitchboard::ui {

class MatchController;
class ReplayController;
class SourceSwitch;

/// Nothing for live robots, and for a session without one. Its game is that of the moment that is
/// shown; none where that is not kept to the tick.
std::optional<link::Scenario> scenarioBehind(const SourceSwitch& source,
                                             const MatchController& match,
                                             const ReplayController& replay);

}  // namespace pitchboard::ui
