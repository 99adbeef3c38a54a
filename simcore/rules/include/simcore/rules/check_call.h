// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Says whether the state of the game allows a referee's call, and if not, why. Pure functions; any
// thread.

#include <optional>
#include <span>

#include <base/game.h>
#include <base/result.h>
#include <simcore/rules/referee.h>
#include <simcore/world/referee_rules.h>
#include <simcore/world/world_state.h>

namespace pitchboard::sim {

/// Returns what callReferee() would return for this call, but changes nothing. Errors:
/// InvalidArgument if the call is incomplete, NotFound if the robot plays in neither team, else
/// Conflict with the reason.
Result<void> checkCall(const Game& game, const RefereeRules& rules,
                       std::span<const RobotIdentity> robots, const RefereeCall& call);

/// Returns true once no remaining shot can change the winner of the shoot-out, or the rules let a
/// coin decide it.
bool shootOutDecided(const Game& game, const RefereeRules& rules);
/// Returns the index of the team for which a coin decided the shoot-out; the same for the same
/// seed. Empty if no coin was needed, or the match is not over.
std::optional<int> tossWinner(const WorldState& world);

}  // namespace pitchboard::sim
