// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Lists the reference processes of this module and all behaviours of the decision process. To add
// one, write its class and add a line to process_registry.cpp. Programs and matches read the list
// of all processes, which contains the advisor, too: <robotlink/advisor/reference_processes.h>. Any
// thread.

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

/// Returns the reference processes in the order in which they are started.
std::span<const ProcessInfo> cognitiveProcesses();

struct BehaviourInfo {
  std::string_view name;
  std::string_view description;
  bool usesPose;  ///< needs localization and team messages
};
/// Returns the behaviours of the decision process, the default first.
std::span<const BehaviourInfo> behaviours();
/// Returns null for an unknown name.
const BehaviourInfo* findBehaviour(std::string_view name);

}  // namespace pitchboard::link
