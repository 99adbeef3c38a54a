// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a robot recorded itself (pitchboard-agent --record): one file, or all files into which one
// recording was split, which have one time axis. Seconds of the recording. Use it on one thread at
// a time; it reads its files for as long as it exists.

#include <functional>
#include <string>
#include <vector>

#include <base/result.h>
#include <telemetry/session/session_reader.h>

namespace pitchboard::link {

/// Returns whether these are the variables of a blackboard that was received or attached.
bool isBoardGroup(const telemetry::GroupInfo& group);

class RobotRecording {
 public:
  static constexpr std::size_t maxFiles = 1000;

  /// Opens the recording that this file belongs to. Its other files are found beside it by their
  /// names, and belong to it if the same start of the agent wrote them. Fails with NotFound if the
  /// file has no blackboard, and as SessionReader::open().
  static Result<RobotRecording> open(const std::string& path);

  const telemetry::GroupInfo& group() const { return info(m_parts.front()); }
  telemetry::TimeRange range() const { return m_range; }
  /// Returns the wall time of second 0 by the robot's clock, which may not be set.
  telemetry::WallTime start() const { return m_parts.front().reader.info().start; }
  /// Returns the map of the robot's variables as JSON. Fails as SessionReader::attachment().
  Result<std::string> catalog() const;
  std::size_t files() const { return m_parts.size(); }
  /// Returns sentences about files that are missing or cannot be read.
  const std::vector<std::string>& notes() const { return m_notes; }

  /// Visits the rows in the closed range, in order of time, until `visit` returns false.
  void rows(telemetry::TimeRange range,
            const std::function<bool(const telemetry::RowView&)>& visit) const;

 private:
  struct Part {
    std::string path;
    int number = 1;
    telemetry::SessionReader reader;
    telemetry::GroupId group = 0;
  };
  static Result<Part> openPart(const std::string& path);
  static const telemetry::GroupInfo& info(const Part& part) {
    return part.reader.groups()[part.group].info;
  }
  void addOthers();

  std::vector<Part> m_parts;  // in order of time
  telemetry::TimeRange m_range;
  std::vector<std::string> m_notes;
};

}  // namespace pitchboard::link
