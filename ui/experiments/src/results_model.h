// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The tables of an experiment: what was measured in each condition, the differences between them,
// what must hold, and every run. One model, given its rows as texts; runs are read from the columns
// when they are shown. UI thread.

#include <QAbstractTableModel>
#include <QStringList>

#include "experiment_play.h"

namespace pitchboard::ui {

class ResultsModel : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum class Kind { Measured, Differences, Assertions, Runs };
  ResultsModel(Kind kind, QObject* parent);

  void show(const PlayedPtr& played);
  /// Of a row of runs.
  std::size_t runNumber(int row) const;

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  void fill();
  /// A row of Kind::Differences.
  void addComparison(const link::MetricInfo& metric, const std::string& of,
                     const std::string& minus, const link::Comparison& one);
  QVariant runCell(int row, int column, bool sorting) const;
  bool isNumeric(int column) const;

  Kind m_kind;
  PlayedPtr m_played;
  QStringList m_heads;
  QList<QStringList> m_rows;           // of all kinds but Runs
  std::vector<std::size_t> m_runs;     // numbers of the runs that are there
  std::vector<std::size_t> m_metrics;  // columns of runs
  std::vector<int> m_decimals;         // of these columns
};

}  // namespace pitchboard::ui
