// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The robots' separate processes as a table, a row for each. Window thread.

#include <QAbstractTableModel>
#include <chrono>
#include <vector>

#include <robotlink/match/match_runner.h>

namespace pitchboard::ui {

class ProcessesModel : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column {
    Robot,
    Process,
    Program,
    State,
    Pid,
    Uptime,
    Restarts,
    Cpu,
    Memory,
    Heartbeat,
    LastOutput,
    columns
  };
  using Time = std::chrono::steady_clock::time_point;
  using QAbstractTableModel::QAbstractTableModel;

  /// `now`: for the time since the start.
  void update(const link::MatchFrame& frame, Time now);
  void clear();
  const link::ProcessStatus& statusAt(int row) const;

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  struct Row {
    link::ProcessStatus status;
    QString robot;
    qint64 seconds = 0;  // since its start
    bool operator==(const Row&) const = default;
  };
  QString text(const Row& row, int column) const;
  std::vector<Row> m_rows;
};

}  // namespace pitchboard::ui
