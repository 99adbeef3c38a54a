// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/processes/management_config.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>

#include <base/lined_json.h>

namespace pitchboard::link {
namespace {

constexpr std::string_view section = "Pitchboard Management";
constexpr std::string_view commandKey = "command.";

using Seconds = ManagementTiming::Seconds;

struct TimeKey {
  std::string_view name;
  Seconds& (*of)(ManagementTiming& timing);
};
constexpr std::array<TimeKey, 6> timeKeys{
    {{"start_interval", [](ManagementTiming& t) -> Seconds& { return t.startInterval; }},
     {"response_timeout", [](ManagementTiming& t) -> Seconds& { return t.responseTimeout; }},
     // The same in version 0.8.
     {"silent_after", [](ManagementTiming& t) -> Seconds& { return t.responseTimeout; }},
     {"restart_wait", [](ManagementTiming& t) -> Seconds& { return t.restart.firstWait; }},
     {"longest_wait", [](ManagementTiming& t) -> Seconds& { return t.restart.maxWait; }},
     {"steady_after", [](ManagementTiming& t) -> Seconds& { return t.restart.steadyAfter; }}}};

std::vector<std::string> namesIn(std::string_view text) {
  std::vector<std::string> names;
  std::string name;
  for (const char c : text) {
    if (c != ',' && std::isspace(static_cast<unsigned char>(c)) == 0) {
      name += c;
    } else if (!name.empty()) {
      names.push_back(std::exchange(name, {}));
    }
  }
  if (!name.empty()) names.push_back(name);
  return names;
}

}  // namespace

std::vector<std::string> splitCommand(std::string_view text) {
  std::vector<std::string> arguments;
  std::string argument;
  bool quoted = false, any = false;
  for (const char c : text) {
    if (c == '"') {
      quoted = !quoted;
      any = true;
    } else if (!quoted && std::isspace(static_cast<unsigned char>(c)) != 0) {
      if (any) arguments.push_back(std::exchange(argument, {}));
      any = false;
    } else {
      argument += c;
      any = true;
    }
  }
  if (any) arguments.push_back(argument);
  return arguments;
}

IntVar workingFlagOf(const std::string& process, const VariableCatalog& catalog) {
  std::string name = process;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return catalog.intVar(name + "_WORKING").value_or(IntVar{-1});
}

Result<ManagementConfig> managementFromIni(const IniFile& file,
                                           const std::vector<std::string>& reference) {
  ManagementConfig config;
  config.processes = reference;
  std::erase(config.processes, "advisor");  // only where it is listed
  std::vector<std::string_view> keys{"processes", "command.NAME"};
  for (const TimeKey& key : timeKeys) keys.push_back(key.name);

  const IniEntry* list = nullptr;
  for (const IniEntry& entry : file.entries) {
    if (entry.section != section) continue;
    const auto refuse = [&](const std::string& text) {
      return failure(ErrorCode::ParseError, entry.name + " " + text, file.place(entry));
    };
    const auto time = std::ranges::find(timeKeys, entry.name, &TimeKey::name);
    if (time != timeKeys.end()) {
      double seconds = 0.0;
      const char* const end = entry.value.data() + entry.value.size();
      const auto [stop, error] = std::from_chars(entry.value.data(), end, seconds);
      if (error != std::errc{} || stop != end || !(seconds > 0.0 && seconds <= 3600.0)) {
        return refuse("must be a number of seconds, more than 0 and at most 3600");
      }
      time->of(config.timing) = Seconds(seconds);
    } else if (entry.name == "processes") {
      config.processes = namesIn(entry.value);
      list = &entry;
      if (config.processes.empty()) return refuse("must name at least one process");
    } else if (entry.name.starts_with(commandKey) && entry.name.size() > commandKey.size()) {
      std::vector<std::string> arguments = splitCommand(entry.value);
      if (arguments.empty()) return refuse("must name a program");
      config.commands[entry.name.substr(commandKey.size())] = std::move(arguments);
    } else {
      return failure(ErrorCode::ParseError, unknownName("key", entry.name, keys),
                     file.place(entry));
    }
  }
  for (auto name = config.processes.begin(); name != config.processes.end(); ++name) {
    if (std::find(config.processes.begin(), name, *name) != name) {
      return failure(ErrorCode::ParseError, "'" + *name + "' is listed twice in \"processes\"",
                     list ? file.place(*list) : file.source);
    }
    if (std::ranges::find(reference, *name) != reference.end() || config.commands.contains(*name))
      continue;
    return failure(ErrorCode::ParseError,
                   "there is no reference process '" + *name +
                       "'; give the command of yours: "
                       "command." +
                       *name + " = PROGRAM ARGUMENTS",
                   list ? file.place(*list) : file.source);
  }
  return config;
}

}  // namespace pitchboard::link
