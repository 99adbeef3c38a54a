// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>
#include <cctype>
#include <cstdio>
#include <exception>

#include <app/command_line.h>
#include <base/try.h>
#include <robotlink/advisor/reference_processes.h>
#include <robotlink/blackboard/system_v.h>
#include <robotlink/processes/guard.h>
#include <robotlink/processes/keeper.h>
#include <robotlink/processes/lock_step_slots.h>

#include "arguments.h"
#include "management.h"
#include "process_loop.h"

namespace pitchboard::robot {
namespace {

// As for every robot process: the first one creates the segment, and none removes it.
Result<link::Blackboard> joinBlackboard(int key) {
  if (const Result<void> made = link::SystemVSegments::create(key);
      !made && made.error().code != ErrorCode::Conflict) {
    return tl::unexpected<Error>(made.error());
  }
  return link::SystemVSegments::open(key, link::AttachMode::AttachOnly);
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
  if (arguments.process.lockStepSlot) {
    return runInLockStep(std::move(process), make, board, robot, *arguments.process.lockStepSlot,
                         shown);
  }
  runUntilStopped(*process, board, robot, shown);
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
  // Those that a ProcessManager starts for itself.
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
  return pitchboard::robot::parseAndRun(argc, argv);
} catch (const std::exception& error) {
  std::fprintf(stderr, "error: %s\n", error.what());
  return pitchboard::shared::exitRefused;
}
