// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A line of the log: of a running match, of Live, in a session file. Plain values; any thread.

#include <cstdint>
#include <string>

namespace pitchboard {

/// The numbers are those of a session file.
enum class LogLevel : std::uint8_t { Unknown, Debug, Info, Warning, Error, Fatal };

struct LogLine {
  double time = 0.0;   ///< s of the source
  std::string origin;  ///< who says it: "simulation", "B1 decision"
  std::string text;
  LogLevel level = LogLevel::Info;
  std::uint32_t cause = 0;  ///< the decision by hand that it tells of; 0: none
  bool isWarning() const { return level >= LogLevel::Warning; }
  bool operator==(const LogLine&) const = default;
};

/// The level of a line that may be a warning.
constexpr LogLevel logLevel(bool warning) {
  return warning ? LogLevel::Warning : LogLevel::Info;
}

}  // namespace pitchboard
