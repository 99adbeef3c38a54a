// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The filter of search fields above tables. UI thread only.

#include <QSortFilterProxyModel>
#include <QStringList>

namespace pitchboard::ui {

/// Keeps rows in which each word occurs in some column, ignoring case.
class TextFilter : public QSortFilterProxyModel {
  Q_OBJECT
 public:
  using QSortFilterProxyModel::QSortFilterProxyModel;

  void setFilterText(const QString& text) {
    m_words = text.split(QLatin1Char(' '), Qt::SkipEmptyParts);
    invalidateFilter();
  }

 protected:
  bool filterAcceptsRow(int row, const QModelIndex& parent) const override {
    if (m_words.isEmpty()) return true;
    QString all;
    for (int c = 0; c < sourceModel()->columnCount(parent); ++c) {
      all += sourceModel()->index(row, c, parent).data().toString() + QLatin1Char('\n');
    }
    return std::all_of(m_words.begin(), m_words.end(), [&all](const QString& word) {
      return all.contains(word, Qt::CaseInsensitive);
    });
  }

 private:
  QStringList m_words;
};

}  // namespace pitchboard::ui
