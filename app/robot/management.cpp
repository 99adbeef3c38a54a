// SPDX-License-Identifier: GPL-3.0-or-later
#include "management.h"

#include <algorithm>
#include <cstdio>

#include <robotlink/blackboard/system_v.h>
#include <robotlink/cognition/process_registry.h>
#include <robotlink/processes/management_config.h>
#include <robotlink/processes/own_program.h>

#include "process_loop.h"

namespace pitchboard::robot {
namespace {

constexpr std::chrono::milliseconds cycle{50};

void replaceAll(std::string& text, std::string_view what, const std::string& with) {
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + with.size())) {
    text.replace(at, what.size(), with);
  }
}

std::vector<std::string> referenceProcesses() {
  std::vector<std::string> names;
  for (const link::ProcessInfo& info : link::cognitiveProcesses()) names.emplace_back(info.name);
  return names;
}

void print(link::ProcessManager& manager) {
  for (const std::string& message : manager.takeMessages()) std::printf("%s\n", message.c_str());
  std::fflush(stdout);
}

}  // namespace

Result<void> manage(CLI::App& command, Arguments& arguments) {
  const std::vector<std::string> given = givenOptions(command);
  Result<link::IniFile> file = settle(command, arguments);
  if (!file) return tl::unexpected<Error>(file.error());
  const Result<link::ManagementConfig> config =
      link::managementFromIni(*file, referenceProcesses());
  if (!config) return tl::unexpected<Error>(config.error());
  const Result<std::string> program = link::ownProgram();
  if (!program) return tl::unexpected<Error>(program.error());

  const std::string robot = std::to_string(arguments.process.robot.value);
  const std::string key = std::to_string(arguments.blackboardKey());
  std::vector<link::ManagedProcess> processes;
  for (const std::string& name : config->processes) {
    std::vector<std::string> words;
    if (const auto own = config->commands.find(name); own != config->commands.end()) {
      words = own->second;
      for (std::string& word : words) {
        replaceAll(word, "{robot}", robot);
        replaceAll(word, "{key}", key);
      }
    } else {
      // Options that this process refuses are told now, not again at every restart.
      if (auto made = link::findProcess(name)->make(arguments.process); !made) {
        return tl::unexpected<Error>(made.error());
      }
      words = {*program, name, "--robot", robot, "--key", key};
      if (!arguments.config.empty()) words.insert(words.end(), {"--config", arguments.config});
      words.insert(words.end(), given.begin(), given.end());
    }
    processes.push_back({name, std::move(words), link::workingFlagOf(name)});
  }
  const bool clearedByOther = std::find(config->processes.begin(), config->processes.end(),
                                        "communication") != config->processes.end();

  Result<link::Blackboard> board =
      link::SystemVSegments::open(arguments.blackboardKey(), link::AttachMode::AttachOrCreate);
  if (!board) return tl::unexpected<Error>(board.error());
  std::printf("management of robot %s on key %s\n", robot.c_str(), key.c_str());
  std::fflush(stdout);
  link::ProcessManager manager(arguments.process.robot, std::move(processes), config->timing,
                               *board, !clearedByOther);
  Result<void> outcome;
  do {
    outcome = manager.step(std::chrono::steady_clock::now());
    print(manager);
  } while (outcome && !askedToEnd(cycle));
  manager.stop();
  print(manager);
  return outcome;
}

}  // namespace pitchboard::robot
