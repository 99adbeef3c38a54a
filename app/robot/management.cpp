// SPDX-License-Identifier: GPL-3.0-or-later
#include "management.h"

#include <algorithm>
#include <cstdio>

#include <base/try.h>
#include <robotlink/advisor/reference_processes.h>
#include <robotlink/blackboard/system_v.h>
#include <robotlink/processes/management_config.h>
#include <robotlink/processes/process_manager.h>
#include <robotlink/processes/team_program.h>

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
  for (const link::ProcessInfo& info : link::referenceProcesses()) names.emplace_back(info.name);
  return names;
}

std::string sentenceOf(const link::ProcessNews& news) {
  using Kind = link::ProcessNewsKind;
  const std::string again =
      news.restartIn < 0
          ? std::string()
          : "; restarting in " + link::inSeconds(link::RestartRule::Seconds(news.restartIn));
  switch (news.kind) {
    case Kind::Started:
    case Kind::Restarted:
      return "started, process " + std::to_string(news.pid);
    case Kind::Ended:
    case Kind::Died:
      return "ended: " + news.detail + again;
    case Kind::NotResponding:
      return "showed " + news.detail + " and was ended" + again;
    case Kind::GivenUp:
      return "is no longer restarted: " + news.detail;
    case Kind::RealTime:
      return "uses real time: " + news.detail;
  }
  return {};
}

void print(link::ProcessManager& manager) {
  for (const link::ProcessLine& line : manager.takeLines()) {
    std::printf("%s: %s\n", line.process.c_str(), line.text.c_str());
  }
  for (const link::ProcessNews& news : manager.takeNews()) {
    std::printf("%s %s\n", news.process.c_str(), sentenceOf(news).c_str());
  }
  std::fflush(stdout);
}

}  // namespace

Result<void> manage(CLI::App& command, Arguments& arguments) {
  const std::vector<std::string> given = givenOptions(command);
  link::IniFile file = TRY(settle(command, arguments));
  const link::ManagementConfig config = TRY(link::managementFromIni(file, referenceProcesses()));
  const std::string program = TRY(link::teamProgram());

  const std::string robot = std::to_string(arguments.process.robot.value);
  const std::string key = std::to_string(arguments.blackboardKey());
  const bool clearedByOther =
      std::ranges::find(config.processes, "communication") != config.processes.end();
  // Words of the extension are for a decision of ours alone.
  const bool announcesSetPlay =
      std::ranges::find(config.processes, "decision") != config.processes.end() &&
      !config.commands.contains("decision") && !arguments.process.announceSetPlay;
  std::vector<link::ManagedProcess> processes;
  for (const std::string& name : config.processes) {
    std::vector<std::string> commandLine;
    if (const auto own = config.commands.find(name); own != config.commands.end()) {
      commandLine = own->second;
      for (std::string& argument : commandLine) {
        replaceAll(argument, "{robot}", robot);
        replaceAll(argument, "{key}", key);
      }
    } else {
      // Reports options that the process refuses now, instead of at every restart.
      TRY(link::findProcess(name)->make(arguments.process));
      commandLine = {program, name, "--robot", robot, "--key", key};
      if (!arguments.config.empty())
        commandLine.insert(commandLine.end(), {"--config", arguments.config});
      commandLine.insert(commandLine.end(), given.begin(), given.end());
      if (announcesSetPlay && name == "communication") commandLine.emplace_back("--set-play");
    }
    link::ManagedProcess process;
    process.spec = {arguments.process.robot, name, std::move(commandLine)};
    process.spec.isTeamProgram = config.commands.contains(name);
    process.restart = config.timing.restart;
    process.delay = config.timing.startInterval.count();
    process.responseTimeout = config.timing.responseTimeout;
    process.heartbeat = link::workingFlagOf(name);
    // A program of the team's own may block for as long as it wants.
    process.watch = link::isPresent(process.heartbeat) ? link::ManagedProcess::Watch::Variable
                    : process.spec.isTeamProgram       ? link::ManagedProcess::Watch::None
                                                       : link::ManagedProcess::Watch::Sleeps;
    process.clears = !clearedByOther;
    processes.push_back(std::move(process));
  }

  link::Blackboard board =
      TRY(link::SystemVSegments::open(arguments.blackboardKey(), link::AttachMode::AttachOrCreate));
  std::printf("management of robot %s on key %s\n", robot.c_str(), key.c_str());
  std::fflush(stdout);
  link::ProcessManager manager(program);
  TRY(manager.keepGuard());
  manager.guardSegment(board);
  using Clock = std::chrono::steady_clock;
  Result<void> outcome;
  for (const link::ManagedProcess& process : processes) {
    TRY(manager.add(process, board, Clock::now()));
  }
  do {
    outcome = manager.step(Clock::now());
    print(manager);
  } while (outcome && !stopRequested(cycle));
  manager.stopAll();
  print(manager);
  return outcome;
}

}  // namespace pitchboard::robot
