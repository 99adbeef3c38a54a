// SPDX-License-Identifier: GPL-3.0-or-later
// blackboard dump, watch, set: values by name. The first two attach read-only.
#include <poll.h>
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <memory>
#include <nlohmann/json.hpp>

#include <base/nearest_name.h>
#include <base/try.h>
#include <robotlink/blackboard/variable_catalog.h>

#include "blackboard_target.h"
#include "interrupt.h"

namespace pitchboard::cli {

using link::AttachMode;
using link::Blackboard;
using link::SystemVSegments;
using link::Variable;
using link::VariableCatalog;
using link::VariableType;
using Words = std::array<std::uint32_t, Blackboard::words>;

void BlackboardTarget::addTo(CLI::App& command) {
  command.add_option("ROBOT", robot, "Robot number")->check(CLI::Range(1, 64));
  addKeysTo(command);
}

void BlackboardTarget::addKeysTo(CLI::App& command) {
  command.add_option("--key", key, "System V key instead of a robot number")
      ->type_name("K")
      ->check(CLI::PositiveNumber);
  command.add_option("--key-base", keyBase, "Added to 100 x robot number")
      ->type_name("B")
      ->check(CLI::Range(0, 2'000'000'000));
}

Result<void> BlackboardTarget::takeRobotFrom(std::vector<std::string>& arguments) {
  if (key != 0) return {};
  const std::string first = arguments.empty() ? std::string() : arguments.front();
  const auto [stop, error] = std::from_chars(first.data(), first.data() + first.size(), robot);
  if (error != std::errc() || stop != first.data() + first.size() || robot < 1 || robot > 64)
    return failure(ErrorCode::InvalidArgument,
                   "a robot number from 1 to 64 comes first, or --key KEY", first);
  arguments.erase(arguments.begin());
  return {};
}

Result<int> BlackboardTarget::resolve() const {
  if ((robot != 0) == (key != 0))
    return failure(ErrorCode::InvalidArgument, "give a robot number or a --key");
  return key != 0 ? key : link::blackboardKey(RobotId{robot}, keyBase);
}

namespace {

/// The catalog in `file`, or the published one when the name is empty.
Result<VariableCatalog> loadCatalog(const std::string& file) {
  return file.empty() ? VariableCatalog::published() : VariableCatalog::fromFile(file);
}

/// A word as a variable of the type: decimal, or the shortest text that gives the same float.
std::string valueText(VariableType type, std::uint32_t word) {
  if (type == VariableType::Int) return std::to_string(std::bit_cast<std::int32_t>(word));
  std::array<char, 64> buffer{};
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), std::bit_cast<float>(word));
  return std::string(buffer.data(), end.ptr);
}

/// The same for JSON, where nan and inf have to be texts.
std::string jsonValueText(VariableType type, std::uint32_t word) {
  const std::string text = valueText(type, word);
  const bool finite = type == VariableType::Int || std::isfinite(std::bit_cast<float>(word));
  return finite ? text : '"' + text + '"';
}

int wordIndex(const Variable& variable) {
  return variable.type == VariableType::Int ? variable.index
                                            : Blackboard::floatOffset + variable.index;
}

std::uint32_t wordOf(const Words& words, const Variable& variable) {
  return words[static_cast<std::size_t>(wordIndex(variable))];
}

Result<Blackboard> openTarget(const BlackboardTarget& target, AttachMode mode) {
  const auto key = TRY(target.resolve());
  return SystemVSegments::open(key, mode);
}

/// The variables of these names, or all of them.
Result<std::vector<Variable>> choose(const VariableCatalog& catalog,
                                     const std::vector<std::string>& names) {
  if (names.empty())
    return std::vector<Variable>(catalog.variables().begin(), catalog.variables().end());
  std::vector<Variable> chosen;
  for (const std::string& name : names) {
    const Variable* const found = catalog.find(name);
    if (found == nullptr) {
      std::vector<std::string_view> known;
      for (const Variable& variable : catalog.variables()) known.push_back(variable.name);
      const std::string_view near = nearestName(name, known);
      return failure(ErrorCode::NotFound,
                     "no such variable in the catalog; " +
                         (near.empty() ? "`pitchboard-cli blackboard dump` lists them all, "
                                         "--catalog FILE reads a team's catalog"
                                       : "did you mean " + std::string(near) + "?"),
                     name);
    }
    chosen.push_back(*found);
  }
  return chosen;
}

// --- dump -------------------------------------------------------------------------------------

struct DumpOptions {
  BlackboardTarget target;
  std::string catalog;
  bool all = false;
  bool json = false;
};

void dumpJson(const VariableCatalog& catalog, const Words& words, int key,
              const std::vector<int>& unnamed) {
  using Json = nlohmann::ordered_json;
  Json out{{"key", key}, {"int", Json::object()}, {"float", Json::object()}};
  for (const Variable& variable : catalog.variables()) {
    Json& values = out[variable.type == VariableType::Int ? "int" : "float"];
    values[variable.name] = Json::parse(jsonValueText(variable.type, wordOf(words, variable)));
  }
  for (const int word : unnamed) {
    out["unnamed_words"][std::to_string(word)] =
        std::bit_cast<std::int32_t>(words[static_cast<std::size_t>(word)]);
  }
  std::printf("%s\n", out.dump(1).c_str());
}

Result<int> dumpValues(DumpOptions& options) {
  const auto catalog = TRY(loadCatalog(options.catalog));
  const auto board = TRY(openTarget(options.target, AttachMode::ReadOnly));
  Words words{};
  board.copyWords(words);

  std::vector<int> unnamed;
  if (options.all) {
    std::array<bool, Blackboard::words> named{};
    for (const Variable& variable : catalog.variables())
      named[static_cast<std::size_t>(wordIndex(variable))] = true;
    for (int word = 0; word < Blackboard::words; ++word) {
      const auto at = static_cast<std::size_t>(word);
      if (!named[at] && words[at] != 0) unnamed.push_back(word);
    }
  }
  if (options.json) {
    dumpJson(catalog, words, board.key(), unnamed);
    return 0;
  }
  for (const Variable& variable : catalog.variables())
    std::printf("%-5s %3d  %-32s %s\n", variable.type == VariableType::Int ? "int" : "float",
                variable.index, variable.name.c_str(),
                valueText(variable.type, wordOf(words, variable)).c_str());
  for (const int word : unnamed) {
    const std::uint32_t value = words[static_cast<std::size_t>(word)];
    std::printf("word  %3d  %-32s %s", word, "(no name)",
                valueText(VariableType::Int, value).c_str());
    if (word >= Blackboard::floatOffset)
      std::printf(" = float %s", valueText(VariableType::Float, value).c_str());
    std::printf("\n");
  }
  return 0;
}

// --- watch ------------------------------------------------------------------------------------

struct WatchOptions {
  BlackboardTarget target;
  std::string catalog;
  std::vector<std::string> names;
  int intervalMs = 20;
  long long count = 0;
  std::optional<double> duration;
  bool json = false;
};

void printChange(const Variable& variable, std::uint32_t before, std::uint32_t now, bool json) {
  using namespace std::chrono;
  const auto time = duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count();
  const std::time_t seconds = time / 1000;
  if (json) {
    std::printf("{\"time\": %lld.%03d, \"name\": \"%s\", \"before\": %s, \"value\": %s}\n",
                static_cast<long long>(seconds), static_cast<int>(time % 1000),
                variable.name.c_str(), jsonValueText(variable.type, before).c_str(),
                jsonValueText(variable.type, now).c_str());
    return;
  }
  std::tm local{};
  localtime_r(&seconds, &local);
  std::printf("%02d:%02d:%02d.%03d  %-32s %s -> %s\n", local.tm_hour, local.tm_min, local.tm_sec,
              static_cast<int>(time % 1000), variable.name.c_str(),
              valueText(variable.type, before).c_str(), valueText(variable.type, now).c_str());
}

Result<int> watch(WatchOptions& options) {
  TRY(options.target.takeRobotFrom(options.names));
  using SteadyClock = std::chrono::steady_clock;
  const auto catalog = TRY(loadCatalog(options.catalog));
  const auto variables = TRY(choose(catalog, options.names));
  const auto board = TRY(openTarget(options.target, AttachMode::ReadOnly));
  const auto opened = TRY(SystemVSegments::info(board.key()));

  const InterruptGuard signals;

  Words before{};
  board.copyWords(before);
  // From this line on the reader knows that no change is missed.
  std::fprintf(stderr, "watching blackboard %d; press Ctrl+C to stop\n", board.key());
  const auto end =
      SteadyClock::now() + std::chrono::duration_cast<SteadyClock::duration>(
                               std::chrono::duration<double>(options.duration.value_or(0.0)));
  auto nextCheck = SteadyClock::now();
  for (long long printed = 0; !interrupted;) {
    Words now{};
    board.copyWords(now);
    for (const Variable& variable : variables) {
      const std::uint32_t old = wordOf(before, variable);
      const std::uint32_t fresh = wordOf(now, variable);
      if (old == fresh) continue;
      printChange(variable, old, fresh, options.json);
      if (++printed == options.count) break;
    }
    if (std::fflush(stdout) != 0) return 0;  // the reader has closed the pipe
    if (options.count > 0 && printed >= options.count) return 0;
    const auto time = SteadyClock::now();
    if (options.duration && time >= end) return 0;
    if (time >= nextCheck) {
      // Removed, or removed and made again: what we hold will never change again.
      const auto there = SystemVSegments::info(board.key());
      if (!there || there->shmid != opened.shmid)
        return failure(ErrorCode::NotFound, "was removed while it was watched",
                       "blackboard " + std::to_string(board.key()));
      nextCheck = time + std::chrono::milliseconds(500);
    }
    before = now;
    poll(nullptr, 0, options.intervalMs);
  }
  return 0;
}

// --- set --------------------------------------------------------------------------------------

struct SetOptions {
  BlackboardTarget target;
  std::string catalog;
  std::vector<std::string> assignments;
};

struct Assignment {
  Variable variable;
  std::int32_t intValue = 0;
  float floatValue = 0.0F;
};

Result<Assignment> parseAssignment(const VariableCatalog& catalog, const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    return failure(ErrorCode::InvalidArgument, "must be NAME=VALUE, such as DECISION_ACTION_A=8",
                   text);
  const auto chosen = TRY(choose(catalog, {text.substr(0, equals)}));
  Assignment assignment{chosen.front()};
  std::string_view value = std::string_view(text).substr(equals + 1);
  if (value.starts_with('+')) value.remove_prefix(1);
  const char* const last = value.data() + value.size();
  const bool isInt = assignment.variable.type == VariableType::Int;
  const auto [stop, error] = isInt ? std::from_chars(value.data(), last, assignment.intValue)
                                   : std::from_chars(value.data(), last, assignment.floatValue);
  if (error == std::errc::result_out_of_range)
    return failure(ErrorCode::InvalidArgument,
                   isInt ? "the value must lie between -2147483648 and 2147483647"
                         : "the value does not fit into a float of 4 bytes",
                   text);
  if (error != std::errc() || stop != last)
    return failure(ErrorCode::InvalidArgument,
                   isInt ? "this variable is an int: the value must be a whole number"
                         : "this variable is a float: the value must be a number, nan or inf",
                   text);
  return assignment;
}

Result<int> set(SetOptions& options) {
  TRY(options.target.takeRobotFrom(options.assignments));
  if (options.assignments.empty())
    return failure(ErrorCode::InvalidArgument, "nothing to write: add NAME=VALUE");
  const auto catalog = TRY(loadCatalog(options.catalog));
  // All are checked before the first is written: a robot never sees half a command.
  std::vector<Assignment> assignments;
  for (const std::string& text : options.assignments) {
    assignments.push_back(TRY(parseAssignment(catalog, text)));
  }
  auto board = TRY(openTarget(options.target, AttachMode::AttachOnly));
  for (const Assignment& assignment : assignments) {
    if (assignment.variable.type == VariableType::Int)
      board.write(link::IntVar{assignment.variable.index}, assignment.intValue);
    else
      board.write(link::FloatVar{assignment.variable.index}, assignment.floatValue);
  }
  return 0;
}

void addCatalogOption(CLI::App& command, std::string& file) {
  command
      .add_option("--catalog", file,
                  "Variable catalog: a team's blackboard.h, SharedMemory.py or JSON (default: the "
                  "published one)")
      ->type_name("FILE");
}

}  // namespace

void addDumpCommand(CLI::App& parent, int& exitCode) {
  const auto options = std::make_shared<DumpOptions>();
  auto* const command =
      parent.add_subcommand("dump",
                            "Print every variable of a blackboard with its value.\n"
                            "Example: pitchboard-cli blackboard dump 1 --json");
  options->target.addTo(*command);
  addCatalogOption(*command, options->catalog);
  command->add_flag("--all", options->all, "Print words without a name, too, unless they are zero");
  command->add_flag("--json", options->json, "Print JSON");
  whenChosen(*command, options, exitCode, &dumpValues);
}

void addWatchCommand(CLI::App& parent, int& exitCode) {
  const auto options = std::make_shared<WatchOptions>();
  auto* const command = parent.add_subcommand(
      "watch",
      "Print changes of a blackboard as they happen.\n"
      "Example: pitchboard-cli blackboard watch 1 DECISION_ACTION_A VISION_BALL_DIST");
  options->target.addKeysTo(*command);
  command
      ->add_option("names", options->names,
                   "Robot number, then the variables to watch (default: all)")
      ->type_name("ROBOT NAME");
  addCatalogOption(*command, options->catalog);
  command->add_option("--interval", options->intervalMs, "Milliseconds between two samples")
      ->type_name("MS")
      ->check(CLI::Range(1, 60'000))
      ->capture_default_str();
  command->add_option("--count", options->count, "Stop after this many changes")
      ->type_name("N")
      ->check(CLI::PositiveNumber);
  shared::addDuration(*command, "--duration", options->duration, "Stop after this time");
  command->add_flag("--json", options->json, "Print one JSON object per line");
  whenChosen(*command, options, exitCode, &watch);
}

void addSetCommand(CLI::App& parent, int& exitCode) {
  const auto options = std::make_shared<SetOptions>();
  auto* const command = parent.add_subcommand(
      "set",
      "Write variables of a blackboard.\n"
      "Example: pitchboard-cli blackboard set 1 DECISION_ACTION_A=8 DECISION_ACTION_B=20");
  options->target.addKeysTo(*command);
  command->add_option("assignments", options->assignments, "Robot number, then the values to write")
      ->required()
      ->type_name("ROBOT NAME=VALUE");
  addCatalogOption(*command, options->catalog);
  whenChosen(*command, options, exitCode, &set);
}

}  // namespace pitchboard::cli
