// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The robots' processes as a table: the newest of each robot and name.

#include <QAbstractTableModel>
#include <vector>

#include <robotlink/match/match_runner.h>

namespace pitchboard::ui {

class ProcessesModel : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { Robot, Process, Pid, State, LastOutput, columns };
  using QAbstractTableModel::QAbstractTableModel;

  void update(const link::MatchFrame& frame);
  void clear();
  RobotId robotAt(int row) const;

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  struct Row {
    link::ChildStatus status;
    QString robot;
    bool operator==(const Row&) const = default;
  };
  std::vector<Row> m_rows;
};

}  // namespace pitchboard::ui
