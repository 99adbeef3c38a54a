// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What is known about each variable and robot over a stretch, as a table: a row each, with the
// states of codes in one cell. UI thread only. Times are s, values in the unit of the row.

#include <QAbstractTableModel>
#include <QDateTime>
#include <QSortFilterProxyModel>
#include <QStringList>
#include <memory>
#include <optional>
#include <vector>

#include "stretch_work.h"

namespace pitchboard::ui {

/// A variable of a robot.
struct StatisticsRow {
  telemetry::StretchLine line;
  std::vector<telemetry::StretchLine> states;  ///< of a code
  double offset = 0.0;                         ///< s, of its session
  int number = 0;                              ///< of its session, as in StretchSource
  bool isMissing = false;  ///< nothing is known about this variable; only its name is
};

class StatisticsModel : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column {
    Session,
    Robot,
    Variable,
    Unit,
    Bias,
    BiasInterval,
    ErrorRms,
    LargestError,
    Correlation,
    Delay,
    DelayedCorrelation,
    Mean,
    MeanInterval,
    Deviation,
    Rms,
    Min,
    P05,
    P25,
    Median,
    P75,
    P95,
    Max,
    States,
    Count,
    Missing,
    Effective,
    Known,
    columns
  };
  static constexpr int timeRole = Qt::UserRole;      ///< s of the source; the moment of this cell
  static constexpr int sortRole = Qt::UserRole + 1;  ///< a number, or text
  using QAbstractTableModel::QAbstractTableModel;

  /// `texts`: what was asked for; each that has no line gets a row that says so. `clock`: the time
  /// of day at second 0; empty: times are shown in seconds.
  void show(const std::shared_ptr<const StretchResult>& result, const QStringList& texts,
            const std::optional<QDateTime>& clock);
  const StatisticsRow& at(int row) const { return m_rows[static_cast<std::size_t>(row)]; }
  /// Returns whether the column says anything about these rows, so that it can be shown.
  bool isUsed(int column) const;
  /// Returns the name of a column in settings, and whether it is shown at first.
  static QString keyOf(int column);
  static bool isShownAtFirst(int column);
  /// Returns rows with all their numbers and states, for a spreadsheet: columns apart by tabs.
  QString spreadsheetText(const std::vector<int>& rows) const;

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  std::vector<StatisticsRow> m_rows;
  std::optional<QDateTime> m_clock;
  bool m_isCompared = false, m_hasCodes = false, m_hasNumbers = false, m_hasSessions = false;
};

/// Sorts numbers as numbers; what is unknown comes last in either order.
class StatisticsSort : public QSortFilterProxyModel {
 public:
  using QSortFilterProxyModel::QSortFilterProxyModel;

 protected:
  bool lessThan(const QModelIndex& left, const QModelIndex& right) const override;
};

}  // namespace pitchboard::ui
