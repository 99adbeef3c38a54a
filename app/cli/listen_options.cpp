// SPDX-License-Identifier: GPL-3.0-or-later
#include "listen_options.h"

#include <cstdio>

namespace pitchboard::cli {

using namespace telemetry;

void addListenOptions(CLI::App& command, ListenOptions& options) {
  command
      .add_option("--bind", options.bind,
                  "Address to receive at; 0.0.0.0 is every interface, with broadcasts")
      ->capture_default_str();
  command.add_option("--port-base", options.portBase, "Robot n sends to port base + n")
      ->capture_default_str();
  command.add_option("--robots", options.robots, "How many ports after the base")
      ->capture_default_str()
      ->check(CLI::Range(1, 64));
  command.add_option("--gamecontroller-port", options.refereePort, "Port of the referee's packets")
      ->capture_default_str();
  command.add_option("--profile", options.profile, "Order of the fields as JSON (docs/LIVE.md)");
  command
      .add_option("--gamecontroller-version", options.refereeVersion,
                  "Only this version of the referee's packets; without it the highest")
      ->check(CLI::Range(7, 255));
  command.add_option("--from", options.senders,
                     "Only robots at these addresses or networks; may be repeated");
  command.add_option("--referee-from", options.refereeSenders,
                     "Only a referee at these addresses or networks; may be repeated");
}

Result<ListenSetup> listenSetup(const ListenOptions& options) {
  ListenSetup setup;
  const auto bind = parseAddress(options.bind);
  if (!bind) return tl::unexpected(bind.error());
  setup.receiver.bind = *bind;
  auto ports = livePorts(options.portBase, options.robots, options.refereePort);
  if (!ports) return tl::unexpected(ports.error());
  setup.receiver.ports = std::move(*ports);
  setup.profile = publishedProfile();
  if (!options.profile.empty()) {
    auto loaded = loadProfile(options.profile);
    if (!loaded) return tl::unexpected(loaded.error());
    setup.profile = std::move(*loaded);
  }
  for (const std::string& sender : options.senders) {
    if (const auto added = setup.monitor.senders.add(sender); !added)
      return tl::unexpected(added.error());
  }
  for (const std::string& sender : options.refereeSenders) {
    if (const auto added = setup.referees.add(sender); !added) return tl::unexpected(added.error());
  }
  return setup;
}

void sayListening(const ListenOptions& options) {
  std::fprintf(stderr, "listening at %s on UDP ports %d to %d and %d\n", options.bind.c_str(),
               options.portBase + 1, options.portBase + options.robots, options.refereePort);
}

void reportPorts(const ReceiverStatus& status, std::map<std::size_t, std::string>& told) {
  for (std::size_t i = 0; i < status.ports.size(); ++i) {
    const PortStatus& port = status.ports[i];
    std::string& last = told[i];
    if (port.problem == last) continue;
    if (port.bound) {
      std::fprintf(stderr, "port %d is received now\n", port.port);
    } else {
      std::fprintf(stderr, "warning: %s It is tried again; the other ports work.\n",
                   port.problem.c_str());
    }
    last = port.problem;
  }
}

std::string refusedText(const TeamStatus& team, std::uint64_t referees) {
  std::string out;
  const auto add = [&out](std::uint64_t count, const char* what) {
    if (count == 0) return;
    out += (out.empty() ? "; refused: " : ", ") + std::to_string(count) + what;
  };
  add(team.refusedByFilter, " of senders that --from does not name");
  add(referees, " of referees that --referee-from does not name");
  add(team.refusedRobots, " of more robots than are kept");
  return out;
}

}  // namespace pitchboard::cli
