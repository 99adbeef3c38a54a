// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The filter of search fields above tables. UI thread only.

#include <QSortFilterProxyModel>
#include <QStringList>
#include <algorithm>

namespace pitchboard::ui {

/// Keeps rows in which each word occurs in some column, ignoring case. Rows that stay after a
/// change stay selected.
class TextFilter : public QSortFilterProxyModel {
  Q_OBJECT
 public:
  using QSortFilterProxyModel::QSortFilterProxyModel;

  void setFilterText(const QString& text) {
    m_words = text.split(QLatin1Char(' '), Qt::SkipEmptyParts);
    filterAgain();
  }

 protected:
  /// To be called when other rows are let through. invalidateFilter() would take scattered rows out
  /// one by one, and move all others each time; this begins anew.
  void filterAgain() { invalidate(); }
  const QStringList& words() const { return m_words; }
  /// Returns whether a word can be a part of a number or a time: in long lists those are written
  /// for no other one.
  static bool isNumeric(const QString& word) {
    return std::ranges::all_of(word, [](QChar c) {
      return c.isDigit() || QStringLiteral(":.,+-").contains(c) || c == QChar(0x2212);
    });
  }
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
