// SPDX-License-Identifier: GPL-3.0-or-later
#include "listen_options.h"

#include <chrono>
#include <cstdio>
#include <thread>

#include <app/usage.h>
#include <base/try.h>
#include <robotlink/live/live_teams.h>

namespace pitchboard::cli {

using namespace telemetry;

std::string profileNames() {
  std::string names;
  for (const std::string& name : builtInProfiles()) names += (names.empty() ? "" : ", ") + name;
  return names;
}

Result<std::vector<TeamSetup>> loadTeams(const std::vector<std::string>& files) {
  std::vector<TeamSetup> teams;
  for (const std::string& file : files) {
    auto team = loadTeamSetup(file);
    if (!team) return tl::unexpected(team.error());
    teams.push_back(std::move(*team));
  }
  return teams;
}

void addListenOptions(CLI::App& command, ListenOptions& options) {
  command
      .add_option("--bind", options.bind,
                  "Address to receive at; 0.0.0.0 is every interface, including broadcasts")
      ->type_name("ADDRESS")
      ->capture_default_str();
  command.add_option("--port-base", options.portBase, "Robot n sends to port base + n")
      ->type_name("PORT")
      ->capture_default_str();
  command.add_option("--robots", options.robots, "Number of robots, and of ports after the base")
      ->type_name("N")
      ->capture_default_str()
      ->check(CLI::Range(1, 64));
  command
      .add_option("--variables-port-base", options.variablesPortBase,
                  "Robot n sends its variables (pitchboard-agent) to this port base + n; 0: off")
      ->type_name("PORT")
      ->capture_default_str();
  command
      .add_option(
          "--catalog", options.catalogs,
          "Catalog of variables that robots send, besides the published one; may be repeated")
      ->type_name("FILE");
  command.add_option("--gamecontroller-port", options.refereePort, "Port of the referee's packets")
      ->type_name("PORT")
      ->capture_default_str();
  command
      .add_option("--profile", options.profile,
                  "Format of the robots' messages: a file (docs/live.md), or " + profileNames())
      ->type_name("FILE|NAME");
  command
      .add_option("--team", options.teams,
                  "Team setup as JSON (ports, senders, profile, colour); may be repeated")
      ->type_name("FILE");
  command
      .add_option("--our-team", options.ourTeam,
                  "Our team, by the referee's number or its colour, such as blue or red: gives its "
                  "robots colour and penalties and lists them first")
      ->type_name("N|COLOUR");
  command
      .add_option(
          "--gamecontroller-version", options.refereeVersion,
          "Accept only this version of the referee's packets; default: the highest received")
      ->type_name("N")
      ->check(CLI::Range(7, 255));
  command
      .add_option("--from", options.senders,
                  "Accept only robots at this address or network; may be repeated")
      ->type_name("ADDRESS");
  command
      .add_option("--referee-from", options.refereeSenders,
                  "Accept only a referee at this address or network; may be repeated")
      ->type_name("ADDRESS");
  shared::addGroup(
      command, "Network",
      {"--bind", "--port-base", "--robots", "--variables-port-base", "--catalog",
       "--gamecontroller-port", "--gamecontroller-version", "--from", "--referee-from"});
}

Result<link::LiveOptions> liveOptions(const ListenOptions& options) {
  link::LiveOptions live;
  live.bind = TRY(parseAddress(options.bind));
  live.portBase = options.portBase;
  live.robots = options.robots;
  live.refereePort = options.refereePort;
  live.variablesPortBase = options.variablesPortBase;
  live.catalogs = options.catalogs;
  live.refereeVersion = options.refereeVersion;
  live.team.teams = TRY(loadTeams(options.teams));
  if (!options.ourTeam.empty()) TRY(link::chooseOurTeam(live, options.ourTeam));
  if (!options.profile.empty()) live.profile = TRY(loadProfile(options.profile));
  for (const std::string& sender : options.senders) TRY(live.team.senders.add(sender));
  for (const std::string& sender : options.refereeSenders) TRY(live.refereeSenders.add(sender));
  TRY(link::validate(live));
  return live;
}

Result<link::LiveDetails> whenListening(const link::LiveWatch& watch) {
  while (true) {
    link::LiveDetails details = watch.details();
    if (!details.networkProblem.empty()) {
      return failure(ErrorCode::SystemError, details.networkProblem);
    }
    if (!details.network.ports.empty()) return details;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

void reportListening(const link::LiveOptions& options, const ReceiverStatus& network) {
  const std::string address = options.bind.text();
  if (options.team.teams.empty()) {
    const int variables = options.variablesPortBase;
    std::fprintf(stderr, "listening at %s on UDP ports %d to %d and %d%s\n", address.c_str(),
                 options.portBase + 1, options.portBase + options.robots, options.refereePort,
                 variables == 0 ? ""
                                : ("; variables on " + std::to_string(variables + 1) + " to " +
                                   std::to_string(variables + options.robots))
                                      .c_str());
    return;
  }
  std::string text;
  for (const PortStatus& port : network.ports) text += " " + std::to_string(port.port);
  std::fprintf(stderr, "listening at %s on UDP ports%s\n", address.c_str(), text.c_str());
}

void reportPorts(const ReceiverStatus& status, std::map<std::size_t, std::string>& reported) {
  for (std::size_t i = 0; i < status.ports.size(); ++i) {
    const PortStatus& port = status.ports[i];
    std::string& last = reported[i];
    if (port.problem == last) continue;
    if (port.bound) {
      std::fprintf(stderr, "port %d is open now\n", port.port);
    } else {
      std::fprintf(stderr, "warning: %s Trying again; the other ports work.\n",
                   port.problem.c_str());
    }
    last = port.problem;
  }
}

std::string refusedText(const link::LiveDetails& details) {
  std::string out;
  const auto add = [&out](std::uint64_t count, const char* what) {
    if (count == 0) return;
    out += (out.empty() ? "; refused: " : ", ") + std::to_string(count) + what;
  };
  add(details.team.refusedByFilter, " from senders outside --from");
  add(details.refusedVariables, " with variables from senders outside --from");
  add(details.refusedReferees, " from referees outside --referee-from");
  add(details.team.refusedRobots, " beyond the robot limit");
  add(details.rows.rows, " rows beyond the limits");
  add(details.rows.values, " values beyond the limits");
  return out;
}

}  // namespace pitchboard::cli
