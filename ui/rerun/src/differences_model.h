// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The differences of a rerun in order of time, as a table: from the recording, or from the last
// rerun. UI thread only.

#include <QAbstractTableModel>
#include <QDateTime>
#include <optional>
#include <vector>

#include <robotlink/rerun/compared_variable.h>

namespace pitchboard::ui {

class DifferencesModel : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { Time, Variable, Before, Rerun, Duration, Largest, columns };
  static constexpr int timeRole = Qt::UserRole;  ///< s of the session
  using QAbstractTableModel::QAbstractTableModel;

  /// `before` is the title of the values that the rerun is compared with: "Recorded". `clock`: the
  /// time of day at second 0; empty: times are shown in seconds.
  void show(std::vector<link::ComparedVariable> variables, const QString& before,
            const std::optional<QDateTime>& clock);
  /// Returns how many differences there are in all; of a variable with very many, only the first
  /// are rows.
  std::uint64_t all() const;

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  struct Row {
    std::size_t variable = 0, stretch = 0;
  };
  QString text(const Row& row, int column) const;

  std::vector<link::ComparedVariable> m_variables;
  std::vector<Row> m_rows;
  QString m_before;
  std::optional<QDateTime> m_clock;
};

}  // namespace pitchboard::ui
