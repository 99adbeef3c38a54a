// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <exception>
#include <memory>

#include <app/command_line.h>
#include <base/try.h>
#include <robotlink/blackboard/system_v.h>
#include <robotlink/cognition/process_registry.h>
#include <robotlink/processes/guard.h>
#include <robotlink/processes/keeper.h>
#include <robotlink/processes/lock_step_slots.h>
#include <robotlink/processes/management_config.h>
#include <robotlink/processes/process_manager.h>
#include <robotlink/processes/team_program.h>

#include "arguments.h"
#include "process_loop.h"

namespace pitchboard::robot {
namespace {

constexpr const char* managementDescription =
    "starts, watches and restarts the robot's other processes";

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
  for (const link::ProcessLine& line : manager.drainLines()) {
    std::printf("%s: %s\n", line.process.c_str(), line.text.c_str());
  }
  for (const link::ProcessNews& news : manager.drainNews()) {
    std::printf("%s %s\n", news.process.c_str(), sentenceOf(news).c_str());
  }
  std::fflush(stdout);
}

/// Runs until SIGTERM, SIGINT or SIGHUP arrives (see holdEndSignals()), then ends the processes
/// that it started and removes the blackboard if it created it. Fails for invalid options, for a
/// mistake in the INI file (with its line), and for a program that cannot be started.
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

// As for every robot process: the first one creates the segment, and none removes it.
Result<link::Blackboard> joinBlackboard(int key) {
  if (const Result<void> made = link::SystemVSegments::create(key);
      !made && made.error().code != ErrorCode::Conflict) {
    return tl::unexpected<Error>(made.error());
  }
  return link::SystemVSegments::open(key, link::AttachMode::AttachOnly);
}

/// Null: the cycles of this process are not announced.
std::unique_ptr<link::CycleAnnouncer> announcerOf(std::string_view process,
                                                  const Arguments& arguments,
                                                  link::Blackboard& board) {
  if (arguments.announceCycles.empty()) return nullptr;
  const auto all = link::cycleWordsFromText(arguments.announceCycles, "--announce-cycles");
  if (!all) return nullptr;  // the option was checked
  const auto found = std::ranges::find(*all, process, &link::CycleWords::process);
  return found == all->end() ? nullptr : std::make_unique<link::CycleAnnouncer>(board, *found);
}

Result<void> run(const link::ProcessInfo& info, CLI::App& command, Arguments& arguments) {
  TRY(settle(command, arguments));
  if (arguments.lockStepSlot) {
    arguments.process.lockStepSlot = TRY(link::LockStepSlot::join(*arguments.lockStepSlot));
  }
  const auto make = [&] { return info.make(arguments.process); };
  auto process = TRY(make());
  const int key = arguments.blackboardKey();
  link::Blackboard board = TRY(joinBlackboard(key));

  std::optional<link::CognitionDebugSender> display;
  if (arguments.cognitionDebugPort)
    display = TRY(link::CognitionDebugSender::to(*arguments.cognitionDebugPort));

  std::string line = std::string(info.name) + " of robot " +
                     std::to_string(arguments.process.robot.value) + " on key " +
                     std::to_string(key);
  if (info.name == "decision") line += ", behaviour " + arguments.process.behaviour;
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
  const RobotId robot = arguments.process.robot;
  link::CognitionDebugSender* const shown = display ? &*display : nullptr;
  const auto announcer = announcerOf(info.name, arguments, board);
  if (arguments.process.lockStepSlot) {
    return runInLockStep(std::move(process), make, board, robot, *arguments.process.lockStepSlot,
                         shown, announcer.get());
  }
  runUntilStopped(*process, board, robot, shown, announcer.get());
  return {};
}

void printList() {
  std::puts("Processes:");
  for (const link::ProcessInfo& info : link::referenceProcesses()) {
    std::printf("  %-14s %s\n", std::string(info.name).c_str(),
                std::string(info.description).c_str());
  }
  std::printf("  %-14s %s\n", "management", managementDescription);
  std::puts("Behaviours of the decision process:");
  for (const link::BehaviourInfo& info : link::behaviours()) {
    std::printf("  %-14s %s\n", std::string(info.name).c_str(),
                std::string(info.description).c_str());
  }
  std::puts(
      "Their parameters, for --behaviour '{\"name\": \"striker\", \"kick_distance\": 0.04}':");
  const link::BehaviourParameters usual;
  for (const link::BehaviourParameter& number : link::behaviourParameters) {
    std::string of;
    for (const std::string_view behaviour : number.of) {
      if (!behaviour.empty()) of += (of.empty() ? "" : ", ") + std::string(behaviour);
    }
    std::printf("  %-22s %g%s%s, %g to %g (%s): %s\n", number.key,
                number.written(usual.*number.member), *number.unit.symbol ? " " : "",
                number.unit.symbol, number.least, number.most, of.c_str(), number.meaning);
  }
}

std::string asSentence(std::string_view description) {
  std::string text(description);
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

int parseAndRun(int argc, char** argv) {
  CLI::App app{
      "The reference processes of a robot. Each attaches to the robot's blackboard like a team's "
      "own process and runs until SIGTERM or Ctrl+C.\n"
      "Example: pitchboard-robot decision --robot 1 --behaviour striker"};
  app.name("pitchboard-robot");
  app.require_subcommand(1);
  app.set_version_flag("--version", PITCHBOARD_VERSION, "Print the version");

  Arguments arguments;
  const auto add = [&](std::string_view name, std::string_view description,
                       std::string_view example) {
    CLI::App* command = app.add_subcommand(
        std::string(name), asSentence(description) + ".\nExample: " + std::string(example));
    addOptions(*command, arguments);
    return command;
  };
  for (const link::ProcessInfo& info : link::referenceProcesses()) {
    add(info.name, info.description, info.example);
  }
  CLI::App* management = add("management", managementDescription,
                             "pitchboard-robot management --robot 1 --behaviour keeper");
  CLI::App* list =
      app.add_subcommand("list", "List processes and behaviours.\nExample: pitchboard-robot list");

  if (const auto ended = shared::parse(app, argc, argv)) return *ended;
  CLI::App* chosen = app.get_subcommands().front();
  if (chosen == list) {
    printList();
    return 0;
  }
  const auto done = chosen == management
                        ? manage(*chosen, arguments)
                        : run(*link::findProcess(chosen->get_name()), *chosen, arguments);
  return done ? 0 : shared::reportError(done.error());
}

}  // namespace

}  // namespace pitchboard::robot

int main(int argc, char** argv) try {
  // Commands that ProcessManager uses to start helpers of its own.
  const std::string_view command = argc > 1 ? argv[1] : "";
  if (command == pitchboard::link::guardCommand) {
    pitchboard::link::runGuard(STDIN_FILENO);
    return 0;
  }
  if (command == pitchboard::link::keepCommand) {
    pitchboard::link::keep({argv + 2, argv + argc});
    return 1;
  }
  pitchboard::robot::holdEndSignals();
  return pitchboard::shared::checkOutput(pitchboard::robot::parseAndRun(argc, argv));
} catch (const std::exception& error) {
  std::fprintf(stderr, "error: %s\n", error.what());
  return pitchboard::shared::exitRefused;
}
