// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The options that choose a part of sessions, the same for every command that reads them. Main
// thread.

#include <optional>
#include <string>
#include <vector>

#include <telemetry/session/session_reader.h>

#include "commands.h"

namespace pitchboard::cli {

/// What was typed for --from, --until and --clock.
struct PartOptions {
  std::string from, until;
  bool clock = false;
};
/// Adds the options. `clockNote` continues the description of --clock.
void addPart(CLI::App& command, PartOptions& options, const std::string& clockNote = {});

/// A part of a session (s); what was not given is empty.
struct Part {
  std::optional<double> from, until;
};
/// Fails with InvalidArgument, which names the option.
Result<Part> partOf(const telemetry::SessionReader& session, const PartOptions& options);

/// Adds --robots and --variables, lists with commas.
void addRobots(CLI::App& command, std::vector<std::string>& robots, const char* description);
void addVariables(CLI::App& command, std::vector<std::string>& variables, const char* description);

}  // namespace pitchboard::cli
