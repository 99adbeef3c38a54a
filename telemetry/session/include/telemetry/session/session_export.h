// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Exports a session, or part of it, as CSV, JSON lines or a shorter session. Numbers are as short
// as possible so that they read back to the same bits; the locale has no influence. Runs on the
// calling thread. Times are seconds of the session.

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
  CsvWide,    ///< a line per time, a column per variable ("B1.VISION_BALL_DIST")
  CsvLong,    ///< a line per value: time, robot, variable, value
  JsonLines,  ///< a line per row or message
  Mcap,       ///< a session with the selected part
  CsvEven     ///< as CsvWide, but at even times, with a value in every cell
};
/// Reads "csv-wide", "csv-long", "jsonl", "mcap" or "csv-even". Fails with InvalidArgument, which
/// lists them.
Result<ExportFormat> exportFormat(std::string_view name);

/// How CsvEven fills times between rows. A row counts for at most 10 s; after that there is a gap.
struct Resampling {
  static constexpr double maxHold = 10.0;  ///< s
  static constexpr double maxPerSecond = 10'000.0;
  double rate = 10.0;        ///< lines per second, above 0
  bool interpolate = false;  ///< linearly between two rows; codes and flags are always held
};

class SessionWriter;

struct ExportSelection {
  TimeRange range{-1e18, 1e18};        ///< s, both ends included
  std::vector<std::string> robots;     ///< names as for groupsNamed(); all if empty
  std::vector<std::string> variables;  ///< names, with * for any letters; all if empty
  bool messages = true;                ///< also events, log and datagrams (JsonLines and Mcap)
  bool clock = false;                  ///< CSV: a column with the time of day (UTC)
  Resampling resampling{};             ///< for CsvEven
  /// May change the text of a message, or return false to leave it out. If it is empty, messages
  /// are unchanged.
  std::function<bool(SessionStream, std::string& json)> change{};
  /// Mcap: JSON messages to write before all others, at the beginning of the range.
  std::vector<std::pair<SessionStream, std::string>> opening{};
  /// Mcap: called before the messages of each time (s), and at the end with the time of the last
  /// one; may add groups, rows and events of its own up to that time. Return false to stop the
  /// export, which then fails with Conflict.
  std::function<bool(SessionWriter&, double time)> beside{};
};

struct ExportReport {
  std::uint64_t lines = 0;  ///< lines of text, or messages of a session
  std::uint64_t bytes = 0;
};

/// Called with the share that is done, 0 to 1. Return false to cancel.
using ExportProgress = std::function<bool(double)>;

/// Fails with InvalidArgument if the range ends before it begins.
Result<void> checkRange(TimeRange range);
/// Fails with NotFound if a robot or variable is not in the session, and as checkRange() does.
Result<void> checkSelection(const SessionReader& session, const ExportSelection& selection);

/// Exports a text format to a sink, about 100 kB at a time. If the sink returns false, the export
/// fails with SystemError. Fails also as checkSelection() does.
Result<ExportReport> exportText(const SessionReader& session, ExportFormat format,
                                const ExportSelection& selection,
                                const std::function<bool(std::string_view)>& sink,
                                const ExportProgress& progress = {});

/// Exports any format to a file, which appears when it is complete. The session itself is refused
/// as target. After an error or a cancel, an existing file is unchanged. Fails also as FileTarget
/// does.
Result<ExportReport> exportFile(const SessionReader& session, ExportFormat format,
                                const ExportSelection& selection, const std::string& path,
                                const ExportProgress& progress = {},
                                IfExists ifExists = IfExists::Refuse);

}  // namespace pitchboard::telemetry
