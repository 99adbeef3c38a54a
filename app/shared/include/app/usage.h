// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes the help page of a program, the messages of usage errors, and scripts for completion in
// shells, all from the options of the program. Used on the main thread.

#include <CLI/CLI.hpp>

#include <initializer_list>
#include <string>
#include <string_view>

namespace pitchboard::shared {

/// Returns a command with its program, such as "pitchboard-cli simulate".
std::string fullName(const CLI::App& app);

/// Puts rarely used options into a group of this name. `--help` only lists them; `--help-all`
/// describes them.
void addGroup(CLI::App& command, const std::string& group,
              std::initializer_list<const char*> options);

/// Installs our help page and `--help-all` in the program and its commands.
void addHelp(CLI::App& app);

/// Returns the help page: summary, examples, usage, options. The description of a command contains
/// its summary, then lines that begin with "Example: " or "Examples: " and indented lines after
/// them.
std::string helpText(const CLI::App& app, CLI::AppFormatMode mode);

/// Returns a sentence, without "error:", that says what is wrong with the command line and suggests
/// what was probably meant.
std::string problemText(const CLI::App& app, const CLI::ParseError& error);

/// Returns a script with which a shell ("bash" or "zsh") completes commands and options of the
/// program, and file names for everything else. Empty for other shells.
std::string completionScript(const CLI::App& app, std::string_view shell);

}  // namespace pitchboard::shared
