// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A line of the log: of a running match, of Live, in a session file. Plain values; any thread.

#include <cstdint>
#include <string>

namespace pitchboard {

/// The values are those in session files; never change them.
enum class LogLevel : std::uint8_t { Unknown, Debug, Info, Warning, Error, Fatal };

struct LogLine {
  double time = 0.0;   ///< s of the source
  std::string origin;  ///< who wrote it: "simulation", "B1 decision"
  std::string text;
  LogLevel level = LogLevel::Info;
  std::uint32_t cause = 0;  ///< number of the call by hand that it reports; 0: none
  bool isWarning() const { return level >= LogLevel::Warning; }
  bool operator==(const LogLine&) const = default;
};

/// Returns the level of a line that may be a warning.
constexpr LogLevel logLevel(bool warning) {
  return warning ? LogLevel::Warning : LogLevel::Info;
}

}  // namespace pitchboard
