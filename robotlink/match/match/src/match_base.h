// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the parts of a simulated match share. Private to the module.

#include <optional>
#include <vector>

#include <robotlink/match/match_options.h>
#include <robotlink/scenario/scenario.h>
#include <simcore/simulation/simulation.h>

#include "timed_writes.h"

namespace pitchboard::link {

struct MatchBase {
  Scenario scenario;
  MatchOptions options;
  sim::Simulation simulation;
  const VariableCatalog* catalog = nullptr;
  RobotVariables variables;
  TimedWrites writes;
  std::optional<CognitionDebugReceiver> cognitionDebug{};
  // In the order of the robots.
  std::vector<sim::RobotCommand> commands{};
  std::vector<sim::Percepts> percepts{};

  std::uint64_t tick() const { return simulation.state().tick; }
  double tickRate() const { return scenario.settings.tickRate; }
};

}  // namespace pitchboard::link
