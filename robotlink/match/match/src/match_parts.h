// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a simulated match consists of. Private to the module.

#include <cstdint>
#include <memory>
#include <optional>

#include <robotlink/match/blackboard_bridge.h>
#include <robotlink/match/match_drawings.h>
#include <robotlink/match/match_end.h>
#include <robotlink/match/robots_memory.h>
#include <robotlink/match/simulated_match.h>

#include "following.h"
#include "lock_step.h"
#include "match_base.h"
#include "match_events.h"
#include "match_referee.h"

namespace pitchboard::link {

struct SimulatedMatch::Parts {
  explicit Parts(MatchBase all)
      : Parts(all, all.catalog == &VariableCatalog::published()
                       ? std::nullopt
                       : std::optional(all.catalog->withExtension())) {}
  Parts(MatchBase& all, const std::optional<VariableCatalog>& ofTeam)
      : Parts(all, ofTeam ? *ofTeam : VariableCatalog::extended()) {}
  Parts(MatchBase& all, const VariableCatalog& extended)
      : base(std::move(all)),
        extendedBridge(RobotVariables(extended)),
        refereeVariables(extended) {}

  void rememberBeliefs();
  Result<void> beginGame();
  void advance(bool again);
  void deliverReferee(bool again = false);
  void followSides();
  void followJump();
  void letGo();
  void startAnew();
  void startAnew(RobotSlot& slot);
  void playThrough(const MomentPast& past);
  void restore(const RobotsMemory& memory);
  Result<void> restore(const Moment& moment);

  MatchBase base;
  BlackboardBridge bridge{base.variables};
  BlackboardBridge extendedBridge;  // of robots whose decision knows the extension of the map
  RefereeVariables refereeVariables;
  MatchEvents events;
  Following following;
  MatchReferee referee;
  std::unique_ptr<MatchDrawings> drawings;
  RobotSlots slots{base};
  ProcessPace pace{base, slots, events};
  LockStep lockStep{base, slots, pace};
  std::uint64_t expectedTick = 0;  // another one means that a moment was restored
  MatchEnd end;
};

}  // namespace pitchboard::link
