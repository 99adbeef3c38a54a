// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The flight recorder: writes each reading of the blackboard that differs from the one before as a
// row of a session file on the robot's own disk (docs/agent.md). Nothing here waits for the disk
// but start() and finish(). A large recording is several files with one time axis: second 0 is the
// beginning of the first. One thread at a time.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include <base/result.h>
#include <robotlink/blackboard/variable_catalog.h>
#include <robotlink/live/board_columns.h>
#include <telemetry/session/session_writer.h>

#include "schedule.h"

namespace pitchboard::agent {

struct RecordOptions {
  /// A file that does not exist yet, or a folder, in which files are named by robot and time.
  std::string path;
  int robot = 1;
  int key = 100;        ///< of the blackboard
  double rate = 100.0;  ///< readings per second
  std::uint64_t fileBytes =
      100'000'000;              ///< a file that has grown to this size is the last but one
  std::uint64_t keepBytes = 0;  ///< the oldest files are deleted to stay below; 0: none is
  /// Recording ends before the disk has less room, which the robot's other programs need.
  std::uint64_t leaveBytes = 64'000'000;
  Time fileTime = std::chrono::hours(2);  ///< the index of a file that hardly grows is memory
  telemetry::SessionWriterOptions writer = robotWriter();

  /// What costs a robot little memory and processor time.
  static telemetry::SessionWriterOptions robotWriter();
};

class Recorder {
 public:
  /// A row is written at least this often, also if nothing changes.
  static constexpr Time maxSilence = std::chrono::seconds(1);

  /// Creates the first file. Fails with Conflict if it exists, with SystemError if the disk does
  /// not take it. `now` is second 0.
  static Result<Recorder> start(const RecordOptions& options, const link::VariableCatalog& catalog,
                                const link::SegmentLayout& layout, Time now);
  Recorder(Recorder&&) noexcept = default;
  Recorder& operator=(Recorder&&) noexcept = default;
  ~Recorder() = default;  ///< ends the file, as finish()

  /// Takes a reading: the words of all variables of the catalog, in its order, as they were at
  /// `now`; empty while there is no blackboard. Returns a message for the log, or an empty text.
  std::string take(Time now, std::span<const std::uint32_t> words);
  /// Writes a line into the log of the recording.
  void note(Time now, const std::string& text);
  /// Returns false after the disk was full or failed; take() said so and does nothing any more.
  bool isRecording() const { return m_writer != nullptr; }
  /// Returns the file that is being written.
  const std::string& path() const { return m_path; }
  /// Ends the file and waits for the disk. Fails with the reason if something of it was lost.
  Result<void> finish();

 private:
  Recorder(const RecordOptions& options, const link::VariableCatalog& catalog,
           const link::SegmentLayout& layout, Time now);
  Result<void> open(Time now);
  std::string lookAfter(Time now);
  std::string nextFile(Time now);
  void append(Time time, std::span<const std::uint32_t> words);
  void dropOldest();
  void close();
  double seconds(Time time) const;

  RecordOptions m_options;
  link::BoardColumns m_columns;
  std::string m_catalog;  // as JSON, for each file
  Time m_zero;
  telemetry::WallTime m_start;  // of second 0
  std::string m_stem;           // of the files' names, with their folder
  std::string m_path;
  int m_files = 0;
  std::deque<std::string> m_older;  // files that may be deleted, the oldest first

  std::unique_ptr<telemetry::SessionWriter> m_writer;
  telemetry::GroupId m_group = 0;
  std::uint64_t m_reportedDropped = 0;
  Time m_opened{}, m_looked{};
  std::jthread m_closing;  // ends the file before this one

  std::vector<std::uint32_t> m_last;  // the newest reading; empty: there was no blackboard
  std::vector<std::uint32_t> m_row;   // reused
  Time m_read{}, m_written{};         // times of the newest reading and of the newest row
};

}  // namespace pitchboard::agent
