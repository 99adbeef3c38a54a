// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the commands that receive from the network have in common.

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

/// "b-human, barelangfc, ...": the profiles that are part of the program.
std::string profileNames();
/// The first error of any of the files.
Result<std::vector<telemetry::TeamSetup>> loadTeams(const std::vector<std::string>& files);

void addListenOptions(CLI::App& command, ListenOptions& options);

Result<link::LiveOptions> liveOptions(const ListenOptions& options);
/// Returns the state of the ports once the watch has tried them. Fails if nothing can be received.
Result<link::LiveDetails> whenListening(const link::LiveWatch& watch);

/// Tells on stderr what is received.
void reportListening(const link::LiveOptions& options, const telemetry::ReceiverStatus& network);
/// Says on stderr which ports are not received, once for each change.
void reportPorts(const telemetry::ReceiverStatus& status,
                 std::map<std::size_t, std::string>& reported);
/// "; refused: 12 of senders that are not on the list, ...": nothing where nothing was.
std::string refusedText(const link::LiveDetails& details);

}  // namespace pitchboard::cli
