// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>

#include <cstdio>
#include <optional>

#include <robotlink/robot_config.h>
#include <robotlink/system_v.h>

#include "process_loop.h"

namespace pitchboard::robot {
namespace {

struct Arguments {
  std::optional<long long> robot;
  std::string config;
  std::optional<int> key;
  int keyBase = 0;
  std::string field = "published", attack;
  link::ProcessOptions process;
};

int report(const Error& error) {
  std::fprintf(stderr, "error: %s\n", error.text().c_str());
  return 2;
}

Result<RobotId> chosenRobot(const Arguments& arguments) {
  if (arguments.robot) return link::robotFromNumber(*arguments.robot);
  if (!arguments.config.empty()) return link::robotFromIniFile(arguments.config);
  return failure(ErrorCode::InvalidArgument,
                 "whose process is this? Give --robot N, or --config FILE.ini with the number");
}

// As every robot process: whoever comes first creates the segment, and nobody removes it.
Result<link::Blackboard> joinBlackboard(int key) {
  if (const Result<void> made = link::SystemVSegments::create(key);
      !made && made.error().code != ErrorCode::Conflict) {
    return tl::unexpected<Error>(made.error());
  }
  return link::SystemVSegments::open(key, link::AttachMode::AttachOnly);
}

int run(const link::ProcessInfo& info, Arguments& arguments) {
  const Result<RobotId> robot = chosenRobot(arguments);
  if (!robot) return report(robot.error());
  arguments.process.robot = *robot;
  const Result<sim::FieldSpec> field = sim::fieldByName(arguments.field);
  if (!field) return report(field.error());
  arguments.process.field = *field;
  if (!arguments.attack.empty()) arguments.process.facesLeft = arguments.attack == "left";
  auto process = info.make(arguments.process);
  if (!process) return report(process.error());
  const int key = arguments.key.value_or(link::blackboardKey(*robot, arguments.keyBase));
  Result<link::Blackboard> board = joinBlackboard(key);
  if (!board) return report(board.error());

  std::string line = std::string(info.name) + " of robot " + std::to_string(robot->value) +
                     " on key " + std::to_string(key);
  if (info.hasBehaviour) line += ", behaviour " + arguments.process.behaviour;
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
  runUntilAsked(**process, *board);
  return 0;
}

void printList() {
  std::puts("Processes:");
  for (const link::ProcessInfo& info : link::cognitiveProcesses()) {
    std::printf("  %-14s %s\n", std::string(info.name).c_str(),
                std::string(info.description).c_str());
  }
  std::puts("Behaviours of the decision process:");
  for (const link::BehaviourInfo& info : link::behaviours()) {
    std::printf("  %-14s %s\n", std::string(info.name).c_str(),
                std::string(info.description).c_str());
  }
}

// Every process takes every option, so that a starter can give one list to all of them.
void addOptions(CLI::App& command, Arguments& a) {
  command.add_option("--robot", a.robot, "Number of the robot, 1 to 64")->type_name("N");
  command.add_option("--config", a.config,
                     "INI file with the number: [Communication] no_player_robofei = N")
      ->type_name("FILE.ini");
  command.add_option("--key", a.key, "Key of the blackboard instead of 100 x robot number")
      ->type_name("K");
  command.add_option("--key-base", a.keyBase, "Added to 100 x robot number")
      ->type_name("B")->capture_default_str();
  command.add_option("--behaviour", a.process.behaviour, "What decision does")
      ->type_name("NAME")->capture_default_str();
  command.add_option("--distance-to-kick", a.process.distanceToKick,
                     "Decision kicks a ball nearer than this; 25 in simulation, 40 on a robot")
      ->type_name("CM")->capture_default_str();
  command.add_option("--udp-address", a.process.udpAddress,
                     "Where communication sends; 255.255.255.255 is everybody on the network")
      ->type_name("ADDRESS")->capture_default_str();
  command.add_option("--telemetry-port-base", a.process.telemetryPortBase,
                     "Telemetry goes to this + robot number")
      ->type_name("PORT")->capture_default_str();
  command.add_option("--team", a.process.team,
                     "Robots with the same number hear each other, on UDP port 10000 + this")
      ->type_name("N")->capture_default_str();
  command.add_option("--attack", a.attack,
                     "Side of the opponents' goal; found out from landmarks and IMU if not given")
      ->type_name("SIDE")->check(CLI::IsMember({"left", "right"}));
  command.add_option("--field", a.field, "Sizes of the field")
      ->type_name("NAME")->capture_default_str();
  command.add_option("--particles", a.process.particles, "Localization: at most this many")
      ->type_name("N")->capture_default_str();
  command.add_flag("--published-localization", a.process.publishedLocalization,
                   "Localization with the published filter's parameters");
  command.add_option("--team-port-base", a.process.teamPortBase,
                     "Team messages go to this + 1, 2, 3 and 4")
      ->type_name("PORT")->capture_default_str();
}

int parseAndRun(int argc, char** argv) {
  CLI::App app{
      "The reference processes of a robot. Each attaches to the robot's blackboard, like a team's\n"
      "own process, and runs until it gets SIGTERM or Ctrl+C.\n"
      "Example: pitchboard-robot decision --robot 1 --behaviour striker"};
  app.name("pitchboard-robot");
  app.require_subcommand(1);
  app.set_version_flag("--version", PITCHBOARD_VERSION);

  Arguments arguments;
  const link::ProcessInfo* chosen = nullptr;
  for (const link::ProcessInfo& info : link::cognitiveProcesses()) {
    const std::string name(info.name);
    CLI::App* command = app.add_subcommand(
        name, std::string(info.description) + "\nExample: " + std::string(info.example));
    addOptions(*command, arguments);
    command->callback([&chosen, &info] { chosen = &info; });
  }
  app.add_subcommand("list", "shows the processes and behaviours\nExample: pitchboard-robot list")
      ->callback(printList);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    std::fprintf(stderr, "error: %s\nRun with --help for the options and an example.\n",
                 error.what());
    return 2;
  }
  return chosen != nullptr ? run(*chosen, arguments) : 0;
}

}  // namespace
}  // namespace pitchboard::robot

int main(int argc, char** argv) {
  pitchboard::robot::holdEndSignals();
  return pitchboard::robot::parseAndRun(argc, argv);
}
