// SPDX-License-Identifier: GPL-3.0-or-later
#include "listen_options.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>

#include <app/option_arguments.h>
#include <base/try.h>

namespace pitchboard::cli {

using namespace telemetry;
using shared::addOptions;

void addListenOptions(CLI::App& command, OptionValues& given) {
  const auto before = command.get_options();
  addOptions(command, link::liveOptionTable(), link::LiveOptions(), given);
  for (CLI::Option* option : command.get_options()) {
    if (std::ranges::find(before, option) == before.end()) option->group("Network");
  }
  for (const char* common : {"--profile", "--team", "--our-team"}) {
    command.get_option(common)->group(command.get_help_ptr()->get_group());
  }
}

Result<link::LiveOptions> liveOptions(const OptionValues& given) {
  link::LiveOptions live;
  TRY(setOptions(live, link::liveOptionTable(), given));
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

void reportPorts(const link::LiveDetails& details, std::map<std::size_t, std::string>& reported) {
  const std::vector<PortStatus>& ports = details.network.ports;
  std::string& shared = reported[ports.size()];
  if (details.sharedPorts != shared) {
    shared = details.sharedPorts;
    std::fprintf(stderr, "%s\n",
                 shared.empty() ? "No other program receives on the robots' ports now."
                                : ("warning: " + shared).c_str());
  }
  for (std::size_t i = 0; i < ports.size(); ++i) {
    const PortStatus& port = ports[i];
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

void reportSources(const link::LiveDetails& details, std::map<std::string, std::string>& reported) {
  for (const link::TopicSourceStatus& source : details.topics) {
    const FoxgloveClientStatus& client = source.client;
    std::string text;
    if (client.state == FoxgloveState::Connected) {
      // The topics come a moment later.
      if (source.channels == 0) continue;
      text = source.source.address.text() + ": connected to " + client.server + " (" +
             client.subprotocol + "), reading " + std::to_string(source.decoded) + " of " +
             std::to_string(source.channels) + " topics";
      for (const std::string& reason : source.unread) text += "\n  " + reason;
    } else if (client.state == FoxgloveState::Waiting) {
      text = "warning: " + client.problem + " Trying again.";
    } else {
      continue;
    }
    std::string& last = reported[source.source.address.text()];
    if (text == last) continue;
    last = text;
    std::fprintf(stderr, "%s\n", text.c_str());
  }
}

std::string refusedText(const link::LiveDetails& details) {
  std::string out;
  const auto add = [&out](std::uint64_t count, const char* what) {
    if (count == 0) return;
    out += (out.empty() ? "; refused: " : ", ") + std::to_string(count) + what;
  };
  add(details.team.refusedByFilter, " from senders outside --from");
  add(details.ignoredSimulated, " of simulated matches (receive them with --simulated)");
  add(details.refusedVariables, " with variables from senders outside --from");
  add(details.refusedReferees, " from referees outside --referee-from");
  add(details.team.refusedRobots, " beyond the robot limit");
  add(details.rows.rows, " rows beyond the limits");
  add(details.rows.values, " values beyond the limits");
  return out;
}

}  // namespace pitchboard::cli
