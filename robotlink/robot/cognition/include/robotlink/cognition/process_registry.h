// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Lists the reference processes of a robot and all behaviours of the decision process. To add one,
// write its class and add a line to process_registry.cpp. Any thread.

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
  /// The variables whose values it uses: names, with * for any text, between blanks. Who writes a
  /// variable is in VariableMeanings::writers().
  std::string_view reads;
  /// What else it gets: "messages of team-mates"; empty: everything is on the blackboard.
  std::string_view receives;
};

/// Returns the reference processes in the order in which they are started.
std::span<const ProcessInfo> referenceProcesses();
/// Returns a process by name; null for an unknown one.
const ProcessInfo* findProcess(std::string_view name);

struct BehaviourInfo {
  std::string_view name;
  std::string_view description;
  bool usesPose;           ///< needs localization and team messages
  std::string_view reads;  ///< as ProcessInfo::reads, of the decision process with this behaviour
};
/// Returns the behaviours of the decision process, the default first.
std::span<const BehaviourInfo> behaviours();
/// Returns null for an unknown name.
const BehaviourInfo* findBehaviour(std::string_view name);

}  // namespace pitchboard::link
