// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which variables are listed, and in which order: those with all the words (in robot, category,
// name or unit), favourites only, recently changed only. A robot or category is listed when one of
// its variables is. What was never set is folded into one row of its category, unless words,
// favourites or changes ask for it. Nothing moves by itself: update() and the setters do it.

#include <QSet>
#include <QSortFilterProxyModel>
#include <QStringList>
#include <optional>

#include "variables_model.h"

namespace pitchboard::ui {

class VariablesFilter : public QSortFilterProxyModel {
  Q_OBJECT
 public:
  explicit VariablesFilter(VariablesModel* model, QObject* parent = nullptr);

  void setFilterText(const QString& text);
  void setFavouritesOnly(bool only);
  /// Only what changed within the last `seconds` of the source's time; nothing: all.
  void setChangedWithin(std::optional<double> seconds);
  bool isFiltering() const;
  bool sortsByNumbers() const;
  /// Off: what was never set stands among the others.
  void setFolding(bool on);
  bool isFolding() const { return m_folding; }
  /// Shows what was never set in these categories (paths), and folds it in all others.
  void setUnfolded(const QSet<QString>& categories);
  const QSet<QString>& unfolded() const { return m_unfolded; }
  /// Looks again: at changes when only those are shown, at values when they give the order, and at
  /// what was set for the first time.
  void update();
  int variableCount() const;  ///< listed now

 protected:
  bool filterAcceptsRow(int row, const QModelIndex& parent) const override;
  bool lessThan(const QModelIndex& left, const QModelIndex& right) const override;

 private:
  bool accepts(const QModelIndex& variable) const;
  /// What was never set is folded there.
  bool foldsIn(const QModelIndex& category) const;

  VariablesModel* m_model;
  QStringList m_words;
  std::optional<double> m_changedWithin;
  bool m_favouritesOnly = false;
  bool m_folding = true;
  QSet<QString> m_unfolded;
  std::uint64_t m_setSeen = 0;
};

}  // namespace pitchboard::ui
