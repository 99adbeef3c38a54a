// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes options of a command line from a table (<base/options.h>). Used at the start of a program,
// on its main thread.

#include <CLI/CLI.hpp>

#include <functional>
#include <map>
#include <string>

#include <base/options.h>

namespace pitchboard::shared {

/// Options that need a window, by name ("--live"), and what to do without one.
using WindowOptions = std::map<std::string, std::string>;

/// Checks an option that takes a whole number. Returns an error message for a negative number,
/// which would otherwise become a huge one; empty if the number is valid.
std::string refuseNegative(const std::string& text);

/// Adds an option. The help shows `usual` as its default unless it is 0, empty or off. `take` is
/// called with the value once problemOf() finds nothing wrong with it; an error that it returns is
/// one of the command line.
CLI::Option* addOption(CLI::App& command, const OptionInfo& option, const OptionValue& usual,
                       std::function<Result<void>(const OptionValue&)> take);

/// Adds the options of a table that have a name, unless the command has one of that name. They are
/// set in `values`, which must live as long as the command.
template <class Values>
void addOptions(CLI::App& command, std::type_identity_t<std::span<const Option<Values>>> table,
                Values& values) {
  for (const Option<Values>& option : table) {
    if (!option.info.name || command.get_option_no_throw("--" + std::string(option.info.name))) {
      continue;
    }
    addOption(command, option.info, option.access.get(values),
              [&](const OptionValue& value) { return setOption(values, option, value); });
  }
}

/// The same, but what is given is kept in `given` by name, for setOptions().
template <class Values>
void addOptions(CLI::App& command, std::type_identity_t<std::span<const Option<Values>>> table,
                const Values& usual, OptionValues& given) {
  for (const Option<Values>& option : table) {
    if (!option.info.name || command.get_option_no_throw("--" + std::string(option.info.name))) {
      continue;
    }
    addOption(command, option.info, option.access.get(usual),
              [&](const OptionValue& value) -> Result<void> {
                given[option.info.name] = value;
                return {};
              });
  }
}

}  // namespace pitchboard::shared
