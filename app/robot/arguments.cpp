// SPDX-License-Identifier: GPL-3.0-or-later
#include "arguments.h"

#include <algorithm>

#include <app/usage.h>
#include <base/try.h>
#include <robotlink/blackboard/cycle_words.h>
#include <robotlink/blackboard/match_number.h>
#include <robotlink/blackboard/system_v.h>
#include <robotlink/cognition/process_registry.h>
#include <robotlink/models/robot_models.h>
#include <simcore/world/field_text.h>
#include <telemetry/sockets/datagram.h>

namespace pitchboard::robot {
namespace {

constexpr std::string_view ourSection = "Pitchboard";

std::string checkBehaviour(const std::string& text) {
  const auto choice = link::behaviourFromText(text, "--behaviour");
  if (choice) return {};
  const Error& error = choice.error();
  return error.code == ErrorCode::NotFound ? error.message : error.text();
}

std::string checkAddress(const std::string& text) {
  const auto valid = telemetry::parseAddress(text);
  return valid ? std::string() : valid.error().text();
}

std::string checkField(const std::string& text) {
  const auto field = sim::fieldFromText(text, "field");
  return field ? std::string() : field.error().text();
}

std::string checkModel(const std::string& text) {
  const auto model = text.find('{') == std::string::npos
                         ? link::loadRobotModel(text)
                         : link::robotModelFromText(text, "--robot-model");
  return model ? std::string() : model.error().text();
}

std::string checkCycles(const std::string& text) {
  const auto all = link::cycleWordsFromText(text, "--announce-cycles");
  if (!all) return all.error().message;
  const auto free = link::checkFree(*all, link::VariableCatalog::extended(), "--announce-cycles");
  return free ? std::string() : free.error().message;
}

void addCommunicationOptions(CLI::App& command, Arguments& a) {
  const CLI::Range port(1, 65535);
  command
      .add_option(
          "--udp-address", a.process.udpAddress,
          "Address that communication and team send to; 255.255.255.255 reaches the whole network")
      ->type_name("ADDRESS")
      ->capture_default_str()
      ->check(checkAddress);
  command
      .add_option("--telemetry-port-base", a.telemetryPortBase,
                  "Telemetry goes to this + robot number; default: the match's, 1240 of match 0")
      ->type_name("PORT");
  command.add_option("--telemetry-rate", a.telemetryRate, "Telemetry datagrams a second")
      ->type_name("HZ")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 20.0));
  command
      .add_option("--team-port-base", a.teamPortBase,
                  "Team messages go to this + 1, 2, 3 and 4; default: the match's, 1230 of match 0")
      ->type_name("PORT");
  command
      .add_option(
          "--team", a.process.team,
          "Robots with the same number exchange messages on UDP port 10000 + this (match 0)")
      ->type_name("N")
      ->capture_default_str()
      ->check(CLI::Range(0, 99));
  command
      .add_option("--referee-team", a.process.refereeTeam,
                  "Our team's number in the GameController; if not given, packets of "
                  "GameControllers are ignored")
      ->type_name("N")
      ->check(CLI::Range(0, 255));
  command.add_flag("--set-play", a.process.announceSetPlay,
                   "Communication: also write the current set play (COM_SET_PLAY) for our decision "
                   "process; management adds this by itself");
  command
      .add_option("--shirt", a.process.shirt,
                  "Number in the GameController; the robot's number if not given")
      ->type_name("N")
      ->check(CLI::Range(1, 20));
  command
      .add_option("--referee-port", a.refereePort,
                  "UDP port of the GameController; default: the match's, 3838 of match 0")
      ->type_name("PORT")
      ->check(port);
  command
      .add_option("--debug-port", a.cognitionDebugPort,
                  "Send particles and path to a studio on this computer, to this UDP port")
      ->type_name("PORT")
      ->check(port);
}

CLI::Option* find(CLI::App& command, std::string name) {
  std::ranges::replace(name, '_', '-');
  for (const std::string_view mine : {"config", "robot", "help", "lock-step-slot"}) {
    if (name == mine) return nullptr;
  }
  return command.get_option_no_throw("--" + name);
}

Result<void> takeOver(CLI::App& command, const link::IniFile& file) {
  for (const link::IniEntry& entry : file.entries) {
    if (entry.section != ourSection) continue;
    CLI::Option* option = find(command, entry.name);
    if (option == nullptr) {
      return failure(ErrorCode::ParseError,
                     "there is no option '" + entry.name +
                         "'; for the options, run "
                         "pitchboard-robot " +
                         command.get_name() + " --help",
                     file.place(entry));
    }
    if (option->count() > 0) continue;
    try {
      option->add_result(entry.value);
      option->run_callback();
    } catch (const CLI::Error& error) {
      return failure(ErrorCode::ParseError, error.what(), file.place(entry));
    }
  }
  return {};
}

}  // namespace

int Arguments::blackboardKey() const {
  return key.value_or(
      link::blackboardKey(process.robot, keyBase + link::MatchNumber{match}.keyBase()));
}

void addOptions(CLI::App& command, Arguments& a) {
  command.add_option("--robot", a.robot, "Number of the robot, 1 to 64")->type_name("N");
  command
      .add_option("--config", a.config,
                  "INI file with the number, [Communication] no_player_robofei = N, and with "
                  "any of these options below [Pitchboard]")
      ->type_name("FILE.ini");
  command.add_option("--key", a.key, "Key of the blackboard instead of 100 x robot number")
      ->type_name("K");
  command.add_option("--key-base", a.keyBase, "Added to 100 x robot number")
      ->type_name("B")
      ->capture_default_str();
  command
      .add_option("--match", a.match,
                  "Number of the match on this computer; sets blackboard keys and ports")
      ->type_name("N")
      ->capture_default_str()
      ->check(CLI::Range(0, link::MatchNumber::most));
  command.add_option("--lock-step-slot", a.lockStepSlot)
      ->group("");  // for the program that plays it
  command
      .add_option("--behaviour", a.behaviour,
                  "Behaviour of the decision process: a name, or an object with numbers as in "
                  "scenario files, such as {\"name\": \"striker\", \"kick_distance\": 0.04}; "
                  "`pitchboard-robot list` lists them all")
      ->type_name("NAME|{...}")
      ->capture_default_str()
      ->check(checkBehaviour);
  command
      .add_option(
          "--parameters", a.parameters,
          "Parameters of the behaviour, unless --behaviour sets them; for example best.json of "
          "`pitchboard-cli learn`")
      ->type_name("FILE");
  command
      .add_option("--distance-to-kick", a.distanceToKick,
                  "The naive behaviour's distance_to_kick: 25 in simulation, 40 on a robot")
      ->type_name("CM");
  addCommunicationOptions(command, a);
  command
      .add_option("--attack", a.attack,
                  "Side of the opponents' goal; estimated from landmarks and IMU if not given")
      ->type_name("SIDE")
      ->check(CLI::IsMember({"left", "right"}));
  command
      .add_option("--field", a.field, "Field: a built-in name, or an object as in scenario files")
      ->type_name("NAME|{...}")
      ->capture_default_str()
      ->check(checkField);
  command
      .add_option("--robot-model", a.model,
                  "Model of the robot (how fast it walks, how far it kicks): a built-in name, a "
                  "file, or an object as in scenario files")
      ->type_name("NAME|FILE|{...}")
      ->capture_default_str()
      ->check(checkModel);
  command
      .add_option("--particles", a.process.particles, "Localization: largest number of particles")
      ->type_name("N")
      ->capture_default_str()
      ->check(CLI::Range(1, 100000));
  command.add_option("--seed", a.process.seed, "Localization: seed of its random numbers")
      ->type_name("N")
      ->capture_default_str();
  command.add_flag("--published-localization", a.process.publishedLocalization,
                   "Localization with the published filter's parameters");
  command
      .add_option("--announce-cycles", a.announceCycles,
                  "Announce the cycles of processes in int variables of the blackboard, and the "
                  "time of their clocks in ms in a second one, for pitchboard-agent "
                  "--record-cycles: decision=460:461,localization=462:463")
      ->type_name("P=W:C,...")
      ->check(checkCycles);
  command
      .add_option("--advisor-memory", a.process.advisor.memory,
                  "Advisor: file with what it learns of the opponents; read at the start, written "
                  "when play stops and at the end")
      ->type_name("FILE");
  command.add_flag("!--advisor-memory-read-only", a.process.keepsMemory,
                   "Advisor: do not write that file");
  shared::addGroup(
      command, "Network",
      {"--udp-address", "--telemetry-port-base", "--telemetry-rate", "--team-port-base", "--team",
       "--referee-team", "--set-play", "--shirt", "--referee-port", "--debug-port"});
  shared::addGroup(command, "Tuning",
                   {"--distance-to-kick", "--particles", "--seed", "--published-localization",
                    "--advisor-memory", "--advisor-memory-read-only", "--announce-cycles"});
}

std::vector<std::string> givenOptions(const CLI::App& command) {
  std::vector<std::string> commandLine;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0 || option->get_lnames().empty()) continue;
    const std::string& name = option->get_lnames().front();
    if (name == "robot" || name == "config" || name == "key" || name == "key-base") continue;
    commandLine.push_back("--" + name);
    if (option->get_items_expected_max() == 0) continue;
    for (const std::string& value : option->results()) commandLine.push_back(value);
  }
  return commandLine;
}

Result<link::IniFile> settle(CLI::App& command, Arguments& a) {
  link::IniFile file;
  if (!a.config.empty()) {
    Result<link::IniFile> read = link::readIniFile(a.config);
    if (!read) return read;
    file = std::move(*read);
    TRY(takeOver(command, file));
  }
  RobotId robot =
      TRY(a.robot ? link::robotFromNumber(*a.robot)
          : !a.config.empty()
              ? link::robotFromIni(file)
              : failure(ErrorCode::InvalidArgument,
                        "--robot is missing: add --robot N, or --config FILE.ini with the number"));
  a.process.robot = robot;
  const sim::FieldSpec field = TRY(sim::fieldFromText(a.field, "--field"));
  a.process.field = field;
  const sim::RobotModel model = TRY(a.model.find('{') == std::string::npos
                                        ? link::loadRobotModel(a.model)
                                        : link::robotModelFromText(a.model, "--robot-model"));
  a.process.model = model;
  link::BehaviourParameters usual;
  if (!a.parameters.empty()) usual = TRY(link::loadBehaviourParameters(a.parameters));
  const auto behaviour = TRY(link::behaviourFromText(a.behaviour, "--behaviour", usual));
  a.process.behaviour = behaviour.name;
  a.process.parameters = behaviour.parameters;
  if (a.distanceToKick) a.process.parameters.distanceToKick = *a.distanceToKick;
  a.process.telemetryPeriod = 1.0 / a.telemetryRate;
  a.process.setMatch(link::MatchNumber{a.match});
  if (a.telemetryPortBase) a.process.telemetryPortBase = *a.telemetryPortBase;
  if (a.teamPortBase) a.process.teamPortBase = *a.teamPortBase;
  if (a.refereePort) a.process.refereePort = *a.refereePort;
  if (!a.attack.empty()) a.process.facesLeft = a.attack == "left";
  return file;
}

}  // namespace pitchboard::robot
