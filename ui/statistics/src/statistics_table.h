// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The table of the statistics: sorted by any column, with the columns that somebody has chosen.
// Extremes lead to their moments. UI thread only.

#include <QStringList>
#include <QTableView>
#include <set>
#include <string>
#include <vector>

#include "statistics_model.h"

class QSettings;

namespace pitchboard::ui {

class StatisticsTable : public QTableView {
  Q_OBJECT
 public:
  /// The chosen columns are kept in `settings`, which may be null.
  StatisticsTable(QSettings* settings, QWidget* parent);

  /// Shows a result, as StatisticsModel::show(). The chosen row stays chosen; without one, the
  /// first is.
  void show(const std::shared_ptr<const StretchResult>& result, const QStringList& texts,
            const std::optional<QDateTime>& clock);
  /// Returns the chosen row; null if there is none.
  const StatisticsRow* current() const;
  bool isEmpty() const { return m_model->rowCount() == 0; }
  /// Returns the selected rows in the order of the table.
  std::vector<const StatisticsRow*> selected() const;
  /// Puts the selected rows on the clipboard, for a spreadsheet.
  void copySelection() const;

 signals:
  void currentShown();              ///< another row was chosen, or it has other numbers
  void momentClicked(double time);  ///< s of the source that is shown

 private:
  const StatisticsRow& rowAt(int sortedRow) const;
  void goTo(const QModelIndex& index);
  void selectRow(const std::string& key);
  bool isColumnShown(int column) const;
  void showColumns();
  void askForColumns(const QPoint& at);
  void chooseColumn(int column, bool on);

  QSettings* m_settings;
  StatisticsModel* m_model;
  StatisticsSort* m_sort;
  QStringList m_columns;  // "+key" and "-key": other than at first
  std::set<int> m_sized;  // columns that have a width
};

}  // namespace pitchboard::ui
