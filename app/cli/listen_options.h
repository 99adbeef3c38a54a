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

/// Adds the options of Live; what is given is kept in `given`, which must live as long as the
/// command.
void addListenOptions(CLI::App& command, OptionValues& given);

/// Returns the options of Live with those that were given. Reads the files that they name.
Result<link::LiveOptions> liveOptions(const OptionValues& given);
/// Returns the state of the ports once the watch has tried them. Fails if nothing can be received.
Result<link::LiveDetails> whenListening(const link::LiveWatch& watch);

/// Prints to stderr on which ports the program listens.
void reportListening(const link::LiveOptions& options, const telemetry::ReceiverStatus& network);
/// Prints to stderr which ports cannot be opened or are shared with other programs, once for each
/// change.
void reportPorts(const link::LiveDetails& details, std::map<std::size_t, std::string>& reported);
/// Prints to stderr how the connections to programs with topics are, once for each change.
void reportSources(const link::LiveDetails& details, std::map<std::string, std::string>& reported);
/// Returns "; refused: 12 of senders that are not on the list, ..."; empty if nothing was refused.
std::string refusedText(const link::LiveDetails& details);

}  // namespace pitchboard::cli
