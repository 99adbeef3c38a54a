// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Rows at even times, whatever times they came at: held, or on the line between two of them.
// Private to the library; one thread.

#include <deque>
#include <functional>
#include <vector>

#include <telemetry/session/session_export.h>

#include "export_selection.h"

namespace pitchboard::telemetry {

/// Numbers of all selected columns at one time; NaN: a hole.
using EvenLine = std::vector<double>;

class EvenRows {
 public:
  using Write = std::function<bool(double time, const EvenLine&)>;
  /// The lines of the session that lie in `range`: their times count from the first row of the
  /// session, and rows from before the range are held.
  EvenRows(const SessionReader& session, const std::vector<SelectedGroup>& selected,
           const Resampling& resampling, TimeRange range);

  /// The rows to add: those of the range, and those around it that count in it.
  TimeRange needed() const { return {m_range.begin - Resampling::maxHold, 1e18}; }
  /// Rows in order of time. Calls `write(time, line)` for every line that is complete; returns
  /// false when it does, or when the range isDone().
  bool add(const SessionItem& item, const Write& write);
  bool isDone() const { return m_any && next() > m_range.end; }
  /// What is left, up to the last row.
  bool end(const Write& write) { return writeUntil(m_last, write); }

 private:
  struct Row {
    double time;
    std::vector<double> values;
  };
  struct Group {
    std::vector<bool> held;  ///< codes and flags: they have nothing between
    std::deque<Row> rows;    ///< from the one that counts at the next line on
    bool selected = false;
  };

  void take(const SessionItem& item);
  double readyUntil(double now) const;
  void fill(double time);
  bool writeUntil(double time, const Write& write);
  double next() const { return m_begin + static_cast<double>(m_lines) / m_resampling.rate; }

  const std::vector<SelectedGroup>& m_selected;
  Resampling m_resampling;
  TimeRange m_range;
  std::vector<Group> m_groups;
  bool m_any = false;
  double m_begin = 0.0, m_last = 0.0;
  std::uint64_t m_lines = 0;
  EvenLine m_line;
};

}  // namespace pitchboard::telemetry
