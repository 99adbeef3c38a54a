// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What was said by the simulation and the robots' processes: a bounded list, the oldest lines go
// first.

#include <QAbstractTableModel>
#include <deque>
#include <vector>

#include <robotlink/match/match_runner.h>

namespace pitchboard::ui {

class LogModel : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { Time, Origin, Text, columns };
  static constexpr std::size_t maxLines = 10'000;
  using QAbstractTableModel::QAbstractTableModel;

  void append(const std::vector<LogLine>& lines);
  void clear();
  /// Lines that were removed to make room.
  quint64 dropped() const { return m_dropped; }

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  std::deque<LogLine> m_lines;
  quint64 m_dropped = 0;
};

/// An event of the simulation in words; `robot` is the name of the robot concerned, or empty.
LogLine eventLine(const sim::Event& event, const QString& robot, double tickRate);

}  // namespace pitchboard::ui
