// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What arrived from robots and referee and could not be read, for the dock of bad messages. Window
// thread; belongs to the dock.

#include <QAbstractTableModel>
#include <vector>

#include <robotlink/live/live_rows.h>
#include <robotlink/live/live_watch.h>

namespace pitchboard::ui {

/// One row for each kind of error of everybody together, each robot, each sender and the referee's
/// port; rows without errors are left out.
class BadMessagesModel : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { Who, Kind, Count, Sample, columns };
  using QAbstractTableModel::QAbstractTableModel;

  void update(const link::LiveDetails& details);
  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  struct Row {
    QString who, kind;
    quint64 count = 0;
    QString sample;
    bool operator==(const Row&) const = default;
  };
  void add(std::vector<Row>& rows, const QString& who, const telemetry::ErrorTally& errors) const;
  std::vector<Row> m_rows;
};

}  // namespace pitchboard::ui
