// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The reference processes of this module and every behaviour of decision. A new one is a class and
// its line in process_registry.cpp. Programs and matches read the list of all processes, which has
// the advisor, too: <robotlink/advisor/reference_processes.h>. Any thread.

#include <memory>
#include <span>
#include <string_view>

#include <base/result.h>
#include <robotlink/cognition/cognitive_process.h>

namespace pitchboard::link {

struct ProcessInfo {
  std::string_view name;         ///< "decision", "communication"
  std::string_view description;  ///< a sentence for --help
  Result<std::unique_ptr<CognitiveProcess>> (*make)(const ProcessOptions& options);
  std::string_view example;  ///< a command line for --help
};

/// In starting order.
std::span<const ProcessInfo> cognitiveProcesses();

struct BehaviourInfo {
  std::string_view name;
  std::string_view description;
  bool usesPose;  ///< needs localization and the team's messages
};
/// Behaviours of the decision process, the default first.
std::span<const BehaviourInfo> behaviours();
/// Nothing for an unknown name.
const BehaviourInfo* findBehaviour(std::string_view name);

}  // namespace pitchboard::link
