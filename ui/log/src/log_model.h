// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What was said by the simulation and the robots' processes: a bounded list, the oldest lines go
// first.

#include <QAbstractTableModel>
#include <QDateTime>
#include <deque>
#include <optional>
#include <vector>

#include <robotlink/match/match_runner.h>

namespace pitchboard::ui {

class LogModel : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { Time, Origin, Text, columns };
  static constexpr std::size_t maxLines = 10'000;
  using QAbstractTableModel::QAbstractTableModel;

  /// `clock`: the time of day at their source's second 0, where it has one.
  void append(const std::vector<LogLine>& lines, const std::optional<QDateTime>& clock = {});
  /// Times as time of day, where the lines' source has one.
  void setTimesOfDay(bool on);
  void clear();
  /// Lines that were removed to make room.
  quint64 dropped() const { return m_dropped; }

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  struct Line : LogLine {
    std::optional<QDateTime> clock;
  };
  std::deque<Line> m_lines;
  bool m_timesOfDay = true;
  quint64 m_dropped = 0;
};

}  // namespace pitchboard::ui
