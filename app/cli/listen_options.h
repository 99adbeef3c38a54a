// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Options of all commands that receive from the network. Main thread.

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include <base/result.h>
#include <robotlink/live/live_watch.h>

namespace pitchboard::cli {

struct ListenOptions {
  std::string bind = "0.0.0.0";
  int portBase = 1240;
  int robots = 16;
  int refereePort = 3838;
  int variablesPortBase = telemetry::pb2PortBase;
  std::vector<std::string> catalogs;
  std::string profile;
  std::vector<std::string> teams;
  std::vector<std::string> senders, refereeSenders;
  int refereeVersion = 0;
  std::string ourTeam;
};

/// Returns the names of the built-in profiles: "b-human, barelangfc, ...".
std::string profileNames();
/// Reads the team setups. Returns the first error.
Result<std::vector<telemetry::TeamSetup>> loadTeams(const std::vector<std::string>& files);

void addListenOptions(CLI::App& command, ListenOptions& options);

Result<link::LiveOptions> liveOptions(const ListenOptions& options);
/// Returns the state of the ports once the watch has tried them. Fails if nothing can be received.
Result<link::LiveDetails> whenListening(const link::LiveWatch& watch);

/// Prints to stderr on which ports the program listens.
void reportListening(const link::LiveOptions& options, const telemetry::ReceiverStatus& network);
/// Prints to stderr which ports cannot be opened, once for each change.
void reportPorts(const telemetry::ReceiverStatus& status,
                 std::map<std::size_t, std::string>& reported);
/// Returns "; refused: 12 of senders that are not on the list, ..."; empty if nothing was refused.
std::string refusedText(const link::LiveDetails& details);

}  // namespace pitchboard::cli
