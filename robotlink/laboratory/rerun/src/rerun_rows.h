// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Writes the robot "B1 rerun" beside the original: its rows, and an event where an output begins to
// differ. Private to the module; one thread.

#include <optional>
#include <vector>

#include <telemetry/session/session_writer.h>

#include "feed.h"
#include "output_comparer.h"
#include "recorded_robot.h"
#include "rerun_program.h"

namespace pitchboard::link {

class RerunRows {
 public:
  /// All outlive it.
  RerunRows(const telemetry::SessionReader& session, const RecordedRobot& recorded,
            const Feed& feed, const std::vector<RerunChoice>& choices)
      : m_session(session), m_recorded(recorded), m_feed(feed), m_choices(choices) {}

  /// Where they go; null: nowhere.
  void setWriter(telemetry::SessionWriter* writer) { m_writer = writer; }
  /// Writes a recorded row, with the outputs that stand on the board.
  void write(const telemetry::RowView& row, const Blackboard& board);
  void write(const std::vector<OutputComparer::Begun>& differences,
             const std::vector<ComparedVariable>& variables);

 private:
  RobotUid uid() const;
  void addGroup();

  const telemetry::SessionReader& m_session;
  const RecordedRobot& m_recorded;
  const Feed& m_feed;
  const std::vector<RerunChoice>& m_choices;
  telemetry::SessionWriter* m_writer = nullptr;
  std::optional<telemetry::GroupId> m_group;
  std::vector<int> m_outputWords;  // of each output: its index in the words of a row
  std::vector<std::uint32_t> m_words;
  std::vector<double> m_values;
  std::vector<std::size_t> m_keptValues;
};

}  // namespace pitchboard::link
