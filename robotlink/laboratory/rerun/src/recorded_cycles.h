// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The cycles of a process that announced them (docs/agent.md, "Cycle by cycle"): n when cycle n
// begins, −n when everything of it is written. A rerun then runs exactly these cycles, each on what
// stood on the blackboard at its beginning. Private to the module; one thread.

#include <optional>
#include <string>

#include <robotlink/session/row_slot.h>

#include "recorded_robot.h"

namespace pitchboard::link {

class RecordedCycles {
 public:
  /// Finds the variable in which the process announced its cycles; nothing if it did not.
  static std::optional<RecordedCycles> find(const telemetry::SessionReader& session,
                                            const RecordedRobot& recorded,
                                            const RerunChoice& choice);

  /// Takes a row. Returns whether a cycle has begun since the last one.
  bool take(const telemetry::RowView& row);
  /// Returns the time of that cycle, s: that of the process's own clock if it announced it, else
  /// that of the row.
  double secondsOf(const telemetry::RowView& row) const;
  /// Returns whether that cycle is the first one of a process that was started again.
  bool beganAnew() const { return m_beganAnew; }
  /// Returns whether a cycle has begun in a row that was taken.
  bool hasBegun() const { return m_last != 0; }
  /// Returns whether the newest row is from within a cycle, so that its outputs are not complete.
  bool isRunning() const { return m_last > 0; }
  /// Returns how many cycles began and ended between two rows.
  std::uint64_t missed() const { return m_missed; }
  const std::string& variable() const { return m_variable; }

 private:
  RecordedCycles(std::string variable, RowSlot slot, RowSlot clock)
      : m_variable(std::move(variable)), m_slot(slot), m_clock(clock) {}

  std::string m_variable;
  RowSlot m_slot, m_clock;
  int m_last = 0;
  bool m_isFirst = true, m_beganAnew = false;
  std::uint64_t m_missed = 0;
};

}  // namespace pitchboard::link
