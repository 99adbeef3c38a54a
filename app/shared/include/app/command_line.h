// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads the command line of a program and prints its errors, in the same way for all programs. Used
// at the start of a program, on its main thread.

#include <CLI/CLI.hpp>

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include <base/result.h>

namespace pitchboard::shared {

/// The exit code after an error message.
inline constexpr int exitRefused = 2;

/// Prints "error: ..." on stderr and returns exitRefused.
int reportError(const Error& error);

/// The error of standard output that cannot be written; `reason` is an errno value, or 0.
Error outputError(int reason);
/// Writes what is left of standard output. Returns `exitCode`, or after an error message
/// exitRefused if some of the output could not be written. The last call of a program.
int checkOutput(int exitCode);

/// Reads the command line. Returns an exit code if the program has to end (help, version, invalid
/// usage). `--option-list NAME` prints the options of the program or command of that name for
/// scripts, one in a line: name, "flag" or "value", and the text of `window` if there is one.
std::optional<int> parse(CLI::App& app, int argc, char** argv,
                         const std::map<std::string, std::string>& window = {});

/// Reads all of the text as a number with a decimal point; empty if it is not one.
std::optional<double> numberFrom(std::string_view text);
/// Reads the value of --speed: simulated seconds per second from 0.01 to 1000, or "max", for which
/// it returns 0. Fails with InvalidArgument.
Result<double> speedFrom(const std::string& text);

/// Adds an option for a duration above 0 and at most 1e9 s, in the formats of secondsFromText().
/// `seconds` is empty if the option is not given; it must live as long as the command.
CLI::Option* addDuration(CLI::App& command, const std::string& name, std::optional<double>& seconds,
                         const std::string& description);

}  // namespace pitchboard::shared
