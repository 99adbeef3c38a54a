// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a program says about its command line: the help page, the words of an error, and the
// scripts by which shells complete it. All of it is made from the options themselves.

#include <CLI/CLI.hpp>

#include <initializer_list>
#include <string>
#include <string_view>

namespace pitchboard::shared {

/// "pitchboard-cli simulate".
std::string fullName(const CLI::App& app);

/// Puts options that few people need into a group of this name. `--help` only names them;
/// `--help-all` describes them.
void addGroup(CLI::App& command, const std::string& group,
              std::initializer_list<const char*> options);

/// Gives the program and its commands our help page and `--help-all`.
void addHelp(CLI::App& app);

/// The help page: summary, examples, usage, options. The description of a command is its summary,
/// then lines that begin with "Example: " or "Examples: ", continued by indented lines.
std::string helpText(const CLI::App& app, CLI::AppFormatMode mode);

/// What is wrong with the command line, and what was probably meant: one sentence without "error:".
std::string problemText(const CLI::App& app, const CLI::ParseError& error);

/// A script by which a shell ("bash" or "zsh") completes commands and options of the program;
/// file names stand for everything else. Empty for another shell.
std::string completionScript(const CLI::App& app, std::string_view shell);

}  // namespace pitchboard::shared
