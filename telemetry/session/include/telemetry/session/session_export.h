// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Writes part of a session in another form: CSV (wide or long), JSON lines, or a shorter session.
// Numbers are written as short as they can be so that reading gives the same bits back, in the same
// way whatever the computer's language is. One thread.

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <base/file_target.h>
#include <base/result.h>
#include <telemetry/session/session_reader.h>

namespace pitchboard::telemetry {

enum class ExportFormat : std::uint8_t {
  CsvWide,  ///< a line per time; a column "B1.VISION_BALL_DIST" per variable, empty where no row is
  CsvLong,  ///< a line per value: time, robot, variable, value
  JsonLines,  ///< a line per row or message
  Mcap,       ///< a session with the selected part
  CsvEven     ///< as CsvWide, but at even times: every variable in every line
};
/// "csv-wide", "csv-long", "jsonl", "mcap", "csv-even". Error InvalidArgument names them.
Result<ExportFormat> exportFormat(std::string_view name);

/// What CsvEven writes between rows. A row counts for at most 10 s: behind that is a hole.
struct Resampling {
  static constexpr double longestHold = 10.0;  ///< s
  static constexpr double mostPerSecond = 10'000.0;
  double rate = 10.0;        ///< lines per second, above 0
  bool interpolate = false;  ///< on the line between two rows; codes and flags are held even then
};

struct ExportSelection {
  TimeRange range{-1e18, 1e18};        ///< s, both ends included
  std::vector<std::string> robots;     ///< names of groups; empty: all
  std::vector<std::string> variables;  ///< names, * stands for any letters; empty: all
  bool messages = true;                ///< events, log, datagrams too (JsonLines and Mcap)
  bool clock = false;                  ///< CSV: the time of day as well, UTC, behind the time
  Resampling resampling{};             ///< of CsvEven
  /// May change the text of a message, or leave it out by saying false; empty: all stay as they
  /// are.
  std::function<bool(SessionStream, std::string& json)> change{};
  /// Mcap: JSON messages that stand before all others, at the beginning of the range.
  std::vector<std::pair<SessionStream, std::string>> opening{};
};

struct ExportReport {
  std::uint64_t lines = 0;  ///< of text, or messages of a session
  std::uint64_t bytes = 0;
};

/// Part done, 0 to 1; false stops.
using ExportProgress = std::function<bool(double)>;

/// Error InvalidArgument when it ends before it begins.
Result<void> checkRange(TimeRange range);
/// Error NotFound when a robot or a variable is not in the session; also as checkRange().
Result<void> checkSelection(const SessionReader& session, const ExportSelection& selection);

/// Text formats into a sink that takes some 100 kB at a time; when it says false the export ends
/// with error SystemError. Errors also as checkSelection().
Result<ExportReport> exportText(const SessionReader& session, ExportFormat format,
                                const ExportSelection& selection,
                                const std::function<bool(std::string_view)>& sink,
                                const ExportProgress& progress = {});

/// Any format into a file, which appears when it is whole. Errors also as FileTarget; the session
/// itself is never the target. After an error, and when stopped, what was there before is there.
Result<ExportReport> exportFile(const SessionReader& session, ExportFormat format,
                                const ExportSelection& selection, const std::string& path,
                                const ExportProgress& progress = {},
                                IfExists ifExists = IfExists::Refuse);

}  // namespace pitchboard::telemetry
