// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The command line of pitchboard-agent. It is parsed without a library, because that would be
// larger than the rest of the program. Plain values; any thread.

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <base/result.h>
#include <robotlink/blackboard/cycle_words.h>
#include <robotlink/blackboard/variable_catalog.h>
#include <telemetry/sockets/datagram.h>

namespace pitchboard::agent {

struct Receiver {
  telemetry::Address address;
  std::optional<int> port;  ///< empty: 1340 + the robot's number
};

struct Arguments {
  static constexpr double slowest = 1.0, fastest = 100.0;   ///< Hz
  static constexpr double minLimit = 16.0, maxLimit = 1e6;  ///< kbit/s
  static constexpr std::size_t maxReceivers = 16;
  static constexpr double fastestRecord = 500.0;  ///< Hz

  int robot = 0;
  std::optional<int> key;
  std::string catalog;             ///< a file, or extendedMap; empty: the published map
  double rate = 20.0;              ///< samples of the blackboard per second
  std::vector<std::string> globs;  ///< empty: every variable
  bool sends = true;               ///< false: --to none
  std::vector<Receiver> receivers;
  std::optional<double> limit;           ///< kbit/s
  std::string record;                    ///< a new file or a folder; empty: nothing is recorded
  double recordRate = 100.0;             ///< Hz
  double recordSize = 100.0;             ///< MB; of one file
  std::optional<double> recordKeep;      ///< MB; of all files, of which the oldest are deleted
  std::vector<link::CycleWords> cycles;  ///< where programs announce their cycles
  bool help = false, version = false;

  int boardKey() const { return key.value_or(100 * robot); }
  /// Returns how often the blackboard is read: what is sent is also recorded.
  double readRate() const {
    if (!sends) return recordRate;
    return record.empty() ? rate : std::max(rate, recordRate);
  }
};

extern const char* const helpText;

/// Instead of a file: the published map with the words of our own processes.
inline constexpr std::string_view extendedMap = "extended";

/// Parses the arguments, without the program's name. Fails with InvalidArgument; the message names
/// the option and its valid values.
Result<Arguments> parseArguments(std::span<const char* const> argv);

/// Returns the map with the variables of --record-cycles, such as DECISION_CYCLE and
/// DECISION_CLOCK. Fails with InvalidArgument if a word has another variable.
Result<link::VariableCatalog> withCycles(const link::VariableCatalog& catalog,
                                         const link::SegmentLayout& layout,
                                         std::span<const link::CycleWords> cycles);

/// Returns whether the name matches. `*` stands for any characters, `?` for one.
bool matchesGlob(std::string_view glob, std::string_view name);

/// Returns the variables that match one of the globs (all if there are none), in the catalog's
/// order. Fails with NotFound for a glob without a match, with Unsupported for a name that is too
/// long to be sent.
Result<std::vector<link::Variable>> chosenVariables(const link::VariableCatalog& catalog,
                                                    std::span<const std::string> globs);

}  // namespace pitchboard::agent
