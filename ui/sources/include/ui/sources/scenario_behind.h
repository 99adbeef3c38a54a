// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Finds the scenario of the source that is shown: that of the simulated match, or the one attached
// to a recorded session. A match that starts from a moment takes physics and noise from it. UI
// thread only.

#include <optional>

#include <robotlink/scenario/scenario.h>

namespace pitchboard::ui {

class MatchController;
class ReplayController;
class ShownMoment;

/// Empty for live robots, and for a session without a scenario. The game is that of the moment
/// shown; there is none if the exact state of that moment is not in memory.
std::optional<link::Scenario> scenarioBehind(const ShownMoment& shown, const MatchController& match,
                                             const ReplayController& replay);

}  // namespace pitchboard::ui
