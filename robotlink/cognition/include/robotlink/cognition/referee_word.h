// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a referee packet says to one robot, as the one word that stands on its blackboard. Any
// thread.

#include <optional>

#include <telemetry/wire/gamecontroller.h>

namespace pitchboard::link {

/// The words that COM_REFEREE knows (SYSTEM.md section 6).
inline constexpr int refereeStop = 1, refereePlay = 2, refereeReady = 11, refereeSet = 12;

/// What a referee packet of any version means to one robot: 1 stop, 2 play, 11 ready, 12 set.
/// `team` is the number in the GameController, `player` the shirt, from 1. A penalised robot, and a
/// substitute, stands (1), as does everybody in INITIAL, FINISHED, a timeout and while the game is
/// stopped. Nothing when the packet is not for this robot's match: its team does not play, or it is
/// true data (RGTD), which only monitors may use.
std::optional<int> refereeWord(const telemetry::RefereeState& state, int team, int player);

}  // namespace pitchboard::link
