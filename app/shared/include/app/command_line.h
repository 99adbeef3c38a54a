// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the command lines of all programs have in common: how they are read, and how a refusal
// looks. Used at the start of a program, in its first thread.

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <string_view>

#include <base/result.h>

namespace pitchboard::shared {

/// The exit code after an error that was told.
inline constexpr int exitRefused = 2;

/// Prints "error: ..." on stderr and returns exitRefused.
int reportError(const Error& error);

/// Reads the command line; an exit code when the program is to end here (help, version, bad usage).
std::optional<int> parse(CLI::App& app, int argc, char** argv);

/// The whole text as a number with a decimal point.
std::optional<double> numberFrom(std::string_view text);

/// Adds an option that takes a length of time above 0, at most 1e9 s, as secondsFromText() reads
/// it. `seconds` stays empty without the option and must live as long as the command.
CLI::Option* addDuration(CLI::App& command, const std::string& name, std::optional<double>& seconds,
                         const std::string& description);

}  // namespace pitchboard::shared
