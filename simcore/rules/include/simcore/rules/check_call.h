// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Whether the state of the game allows a call of the referee, and why not. Pure; any thread.

#include <span>

#include <base/result.h>
#include <simcore/rules/referee.h>
#include <simcore/world/game_state.h>
#include <simcore/world/referee_rules.h>
#include <simcore/world/world_state.h>

namespace pitchboard::sim {

/// What callReferee() would say of this call: nothing changes. Errors: InvalidArgument when the
/// call lacks something, NotFound for a robot of neither team, else Conflict with the reason.
Result<void> checkCall(const GameState& game, const RefereeRules& rules,
                       std::span<const RobotIdentity> robots, const RefereeCall& call);

/// No shot can change who wins any more.
bool shootOutDecided(const GameState& game, const RefereeRules& rules);

}  // namespace pitchboard::sim
