// SPDX-License-Identifier: GPL-3.0-or-later
#include "arguments.h"

#include <algorithm>
#include <charconv>

#include <nlohmann/json.hpp>

#include <base/try.h>
#include <robotlink/blackboard/cycle_words.h>
#include <telemetry/pb2/pb2.h>
#include <telemetry/sockets/socket_address.h>

namespace pitchboard::agent {
namespace {

constexpr int mostKey = 2'000'000'000;

tl::unexpected<Error> invalid(const std::string& message) {
  return failure(ErrorCode::InvalidArgument, message);
}

template <class Number>
Result<Number> numberIn(std::string_view option, std::string_view text, Number least, Number most,
                        const char* range) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end || !(value >= least && value <= most)) {
    return invalid(std::string(option) + " must be " + range + ", not \"" +
                   std::string(text.substr(0, 40)) + "\"");
  }
  return value;
}

Result<Receiver> receiverFrom(std::string_view text) {
  Receiver receiver;
  const std::size_t colon = text.find(':');
  const std::string_view host = text.substr(0, colon);
  if (host == "broadcast") {
    receiver.address.value = 0xffffffff;
  } else {
    const auto address = telemetry::parseAddress(host);
    if (!address) {
      return invalid(
          "--to must be ADDRESS, ADDRESS:PORT, broadcast or none, with an address such as "
          "192.168.0.7, not \"" +
          std::string(text.substr(0, 40)) + "\"");
    }
    receiver.address = *address;
  }
  if (colon != std::string_view::npos) {
    receiver.port = TRY(numberIn<int>("the port of --to", text.substr(colon + 1), 1,
                                      telemetry::highestPort, "1 to 65535"));
  }
  return receiver;
}

Result<std::vector<std::string>> globsFrom(std::string_view text) {
  std::vector<std::string> globs;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    if (comma == at) return invalid("--variables has an empty name; write it as VISION_*,VOLTAGE");
    globs.emplace_back(text.substr(at, comma - at));
    at = comma + 1;
  }
  return globs;
}

Result<void> takeOption(Arguments& arguments, std::string_view option, std::string_view value) {
  if (option == "--robot") {
    arguments.robot = TRY(numberIn<int>(option, value, 1, telemetry::Pb2Limits::robots, "1 to 64"));
  } else if (option == "--key") {
    arguments.key = TRY(numberIn<int>(option, value, 1, mostKey, "a positive number"));
  } else if (option == "--rate") {
    arguments.rate =
        TRY(numberIn<double>(option, value, Arguments::slowest, Arguments::fastest, "1 to 100 Hz"));
  } else if (option == "--limit") {
    arguments.limit = TRY(numberIn<double>(option, value, Arguments::minLimit, Arguments::maxLimit,
                                           "16 to 1000000 kbit/s"));
  } else if (option == "--catalog") {
    arguments.catalog = value;
  } else if (option == "--variables") {
    for (std::string& glob : TRY(globsFrom(value))) arguments.globs.push_back(std::move(glob));
  } else if (option == "--record") {
    if (value.empty()) return invalid("--record needs the name of a new file, or of a folder");
    arguments.record = value;
  } else if (option == "--record-rate") {
    arguments.recordRate = TRY(numberIn<double>(option, value, Arguments::slowest,
                                                Arguments::fastestRecord, "1 to 500 Hz"));
  } else if (option == "--record-size") {
    arguments.recordSize = TRY(numberIn<double>(option, value, 1.0, 1e6, "1 to 1000000 MB"));
  } else if (option == "--record-keep") {
    arguments.recordKeep = TRY(numberIn<double>(option, value, 2.0, 1e7, "2 to 10000000 MB"));
  } else if (option == "--record-cycles") {
    arguments.cycles = TRY(link::cycleWordsFromText(value, option));
  } else if (value == "none") {
    arguments.sends = false;
  } else {
    arguments.receivers.push_back(TRY(receiverFrom(value)));
  }
  return {};
}

Result<void> checkRecord(const Arguments& arguments) {
  if (!arguments.sends && !arguments.receivers.empty()) {
    return invalid("--to none cannot stand beside another --to");
  }
  if (!arguments.sends && arguments.record.empty()) {
    return invalid("with --to none there is nothing to do; add --record FILE");
  }
  const Arguments usual;
  const bool isSet = arguments.recordKeep || arguments.recordRate != usual.recordRate ||
                     arguments.recordSize != usual.recordSize || !arguments.cycles.empty();
  if (isSet && arguments.record.empty()) {
    return invalid(
        "--record-rate, --record-size, --record-keep and --record-cycles say how; add --record "
        "FILE");
  }
  if (arguments.recordKeep && *arguments.recordKeep < 2.0 * arguments.recordSize) {
    return invalid(
        "--record-keep must be at least twice --record-size, because whole files are "
        "deleted");
  }
  return {};
}

}  // namespace

const char* const helpText =
    R"(Send the variables of a robot's blackboard to Pitchboard, or record them on the robot. Runs on the
robot, reads its blackboard and changes nothing. Waits until there is a blackboard and a network.
Receives nothing.

Examples:
  pitchboard-agent --robot 1 --to 192.168.0.7
  pitchboard-agent --robot 1 --to none --record match.mcap

Usage: pitchboard-agent --robot N [OPTIONS]

Options:
  --robot N             Number of the robot, 1 to 64
  --to ADDRESS[:PORT]   Computer to send to, such as 192.168.0.7, or "broadcast" for all computers
                        of the network (default), or "none". Repeat it to send to several. The port
                        is 1340 + robot number unless given
  --rate HZ             Highest rate of changed values, 1 to 100 (default 20). Every value is sent
                        every 2 s even if it has not changed
  --variables GLOB,...  Send only these, such as VISION_*,VOLTAGE (default: all)
  --limit KBIT/S        Stay below this bandwidth, at least 16. A quarter of it is kept for values
                        that have not changed
  --catalog FILE        The team's own map of variables: .json, .h, .hpp or .py (default: the
                        published map), or "extended": with those of the reference processes
  --key K               Key of the blackboard instead of 100 x robot number
  --record FILE|FOLDER  Record every change of the blackboard, of all variables, into a new session
                        file, or in this folder in files named by robot and time
  --record-rate HZ      How often the blackboard is read for it, 1 to 500 (default 100)
  --record-size MB      Continue in a new file at this size (default 100)
  --record-cycles P=W   Int variables in which programs announce their cycles, such as
                        decision=460,localization=459: the blackboard is read at each beginning
                        and end, and rerun runs exactly these cycles. decision=460:461 records the
                        program's clock, too (pitchboard-robot --announce-cycles)
  --record-keep MB      Delete the oldest files to stay below this size (default: keep all)
  -h, --help            Print this page
  --version             Print the version
)";

Result<Arguments> parseArguments(std::span<const char* const> argv) {
  static constexpr std::string_view options[] = {
      "--robot", "--key",    "--rate",        "--limit",       "--variables",   "--catalog",
      "--to",    "--record", "--record-rate", "--record-size", "--record-keep", "--record-cycles"};
  Arguments arguments;
  for (std::size_t i = 0; i < argv.size(); ++i) {
    const std::string_view argument = argv[i];
    if (argument == "-h" || argument == "--help") {
      arguments.help = true;
      continue;
    }
    if (argument == "--version") {
      arguments.version = true;
      continue;
    }
    const std::size_t equals = argument.find('=');
    const std::string_view option = argument.substr(0, equals);
    if (std::ranges::find(options, option) == std::end(options)) {
      return invalid("there is no option \"" + std::string(argument.substr(0, 40)) + "\"");
    }
    if (equals != std::string_view::npos) {
      TRY(takeOption(arguments, option, argument.substr(equals + 1)));
    } else if (++i < argv.size()) {
      TRY(takeOption(arguments, option, argv[i]));
    } else {
      return invalid(std::string(option) + " needs a value");
    }
  }
  if (arguments.help || arguments.version) return arguments;
  if (arguments.robot == 0) return invalid("--robot is missing: the number of the robot, 1 to 64");
  TRY(checkRecord(arguments));
  if (!arguments.sends) return arguments;
  if (arguments.receivers.empty()) {
    arguments.receivers.push_back(TRY(receiverFrom("broadcast")));
  }
  const std::size_t receivers = arguments.receivers.size();
  if (receivers > Arguments::maxReceivers) return invalid("at most 16 computers can be sent to");
  const double least = Arguments::minLimit * static_cast<double>(receivers);
  if (arguments.limit && *arguments.limit < least) {
    return invalid("--limit must be at least 16 kbit/s for each of the " +
                   std::to_string(receivers) + " computers");
  }
  return arguments;
}

Result<link::VariableCatalog> withCycles(const link::VariableCatalog& catalog,
                                         const link::SegmentLayout& layout,
                                         std::span<const link::CycleWords> cycles) {
  if (cycles.empty()) return catalog;
  TRY(link::checkFree(cycles, catalog, "--record-cycles"));
  auto map = nlohmann::ordered_json::parse(catalog.toJson(layout));
  map.erase("segment");  // the map is for any
  for (const link::CycleWords& words : cycles) {
    map["int"][link::cycleVariable(words.process, link::cycleSuffix)] = words.cycle.index;
    if (!words.clock) continue;
    map["int"][link::cycleVariable(words.process, link::clockSuffix)] = words.clock->index;
  }
  return link::VariableCatalog::fromJson(map.dump(), "--record-cycles");
}

bool matchesGlob(std::string_view glob, std::string_view name) {
  // Where the last star stands, and how much of the name it has taken.
  std::size_t star = std::string_view::npos, taken = 0, g = 0, n = 0;
  while (n < name.size()) {
    if (g < glob.size() && glob[g] == '*') {
      star = g++;
      taken = n;
    } else if (g < glob.size() && (glob[g] == '?' || glob[g] == name[n])) {
      ++g;
      ++n;
    } else if (star != std::string_view::npos) {
      g = star + 1;
      n = ++taken;
    } else {
      return false;
    }
  }
  return glob.find_first_not_of('*', g) == std::string_view::npos;
}

Result<std::vector<link::Variable>> chosenVariables(const link::VariableCatalog& catalog,
                                                    std::span<const std::string> globs) {
  std::vector<bool> used(globs.size());
  std::vector<link::Variable> chosen;
  for (const link::Variable& variable : catalog.variables()) {
    bool wanted = globs.empty();
    for (std::size_t i = 0; i < globs.size(); ++i) {
      if (!matchesGlob(globs[i], variable.name)) continue;
      wanted = used[i] = true;
    }
    if (!wanted) continue;
    if (!telemetry::isPb2Name(variable.name)) {
      return failure(ErrorCode::Unsupported,
                     "the name " + variable.name.substr(0, 40) +
                         "... has more than 64 characters; shorten it in the catalog");
    }
    chosen.push_back(variable);
  }
  const auto unused = std::ranges::find(used, false);
  if (unused == used.end()) return chosen;
  return failure(ErrorCode::NotFound,
                 "no variable of the catalog matches \"" +
                     globs[static_cast<std::size_t>(unused - used.begin())] +
                     "\"; names are in the catalog's file, * stands for any characters");
}

}  // namespace pitchboard::agent
