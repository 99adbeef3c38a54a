// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the commands that receive from the network have in common.

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include <base/result.h>
#include <telemetry/wire/profile.h>
#include <telemetry/wire/team_monitor.h>
#include <telemetry/wire/udp_receiver.h>

namespace pitchboard::cli {

struct ListenOptions {
  std::string bind = "0.0.0.0";
  int portBase = 1240;
  int robots = 16;
  int refereePort = 3838;
  std::string profile;
  std::vector<std::string> senders, refereeSenders;
  int refereeVersion = 0;
};

void addListenOptions(CLI::App& command, ListenOptions& options);

struct ListenSetup {
  telemetry::ReceiverOptions receiver;
  telemetry::Profile profile;
  telemetry::MonitorOptions monitor;
  telemetry::SenderFilter referees;
};
Result<ListenSetup> listenSetup(const ListenOptions& options);

/// Tells on stderr what is received.
void sayListening(const ListenOptions& options);
/// Says on stderr which ports are not received, once for each change.
void reportPorts(const telemetry::ReceiverStatus& status, std::map<std::size_t, std::string>& told);
/// "; refused: 12 of senders that are not on the list, ...": nothing where nothing was.
std::string refusedText(const telemetry::TeamStatus& team, std::uint64_t referees);

}  // namespace pitchboard::cli
