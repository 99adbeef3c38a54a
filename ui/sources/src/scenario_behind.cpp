// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/match_controller.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/scenario_behind.h>
#include <ui/sources/source_switch.h>

namespace pitchboard::ui {

std::optional<link::Scenario> scenarioBehind(const SourceSwitch& source,
                                             const MatchController& match,
                                             const ReplayController& replay) {
  if (source.kind() == SourceKind::Simulate) return match.scenario();
  if (source.kind() != SourceKind::Replay || replay.attachedScenario().empty()) return {};
  auto read = link::scenarioFromJson(replay.attachedScenario(), "the session's scenario");
  if (!read) return {};
  return std::move(*read);
}

}  // namespace pitchboard::ui
