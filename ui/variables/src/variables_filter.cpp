// SPDX-License-Identifier: GPL-3.0-or-later
#include "variables_filter.h"

#include <algorithm>
#include <cmath>

namespace pitchboard::ui {

VariablesFilter::VariablesFilter(VariablesModel* model, QObject* parent)
    : QSortFilterProxyModel(parent), m_model(model) {
  // Values change ten times a second; rows that jumped about as often could not be read.
  setDynamicSortFilter(false);
  setSourceModel(model);
  connect(model, &VariablesModel::favouritesChanged, this, [this] {
    if (m_favouritesOnly) invalidateFilter();
  });
}

void VariablesFilter::setFilterText(const QString& text) {
  m_words = text.toLower().split(QLatin1Char(' '), Qt::SkipEmptyParts);
  for (QString& word : m_words) word.replace(QLatin1Char('/'), QLatin1Char('\n'));
  invalidateFilter();
}

void VariablesFilter::setFavouritesOnly(bool only) {
  m_favouritesOnly = only;
  invalidateFilter();
}

void VariablesFilter::setChangedWithin(std::optional<double> seconds) {
  m_changedWithin = seconds;
  if (seconds) m_model->refreshChanges();
  invalidateFilter();
}

bool VariablesFilter::isFiltering() const {
  return !m_words.isEmpty() || m_favouritesOnly || m_changedWithin;
}

bool VariablesFilter::sortsByNumbers() const {
  return sortColumn() == VariablesModel::Value || sortColumn() == VariablesModel::Rate ||
         sortColumn() == VariablesModel::Age;
}

void VariablesFilter::setFolding(bool on) {
  m_folding = on;
  invalidateFilter();
}

void VariablesFilter::setUnfolded(const QSet<QString>& categories) {
  if (categories == m_unfolded) return;
  m_unfolded = categories;
  m_model->setRestShown(categories);
  invalidateFilter();
}

void VariablesFilter::update() {
  if (m_setSeen != m_model->setRevision()) {
    m_setSeen = m_model->setRevision();
    invalidateFilter();
  }
  if (m_changedWithin) {
    m_model->refreshChanges();
    invalidateFilter();
  }
  if (sortsByNumbers()) {
    m_model->refreshAll();
    sort(sortColumn(), sortOrder());
  }
}

int VariablesFilter::variableCount() const {
  int count = 0;
  for (int g = 0; g < rowCount(); ++g) {
    const QModelIndex group = index(g, 0);
    for (int h = 0; h < rowCount(group); ++h) {
      const QModelIndex category = index(h, 0, group);
      const int rows = rowCount(category);
      const QModelIndex last = mapToSource(index(rows - 1, 0, category));
      const bool rest = rows > 0 && m_model->kindOf(last) == VariablesModel::Kind::Rest;
      count += rest ? rows - 1 : rows;
    }
  }
  return count;
}

bool VariablesFilter::accepts(const QModelIndex& variable) const {
  if (m_favouritesOnly && !variable.data(VariablesModel::FavouriteRole).toBool()) return false;
  if (m_changedWithin && m_model->now() - m_model->lastChange(variable) > *m_changedWithin) {
    return false;
  }
  const QString& text = m_model->searchText(variable);
  return std::all_of(m_words.begin(), m_words.end(),
                     [&text](const QString& word) { return text.contains(word); });
}

// The filter finds a name; the name of a robot alone finds no variable.
bool VariablesFilter::foldsIn(const QModelIndex& category) const {
  if (!m_folding || m_favouritesOnly || m_changedWithin) return false;
  if (m_model->neverSetCount(category) == 0) return false;
  const QModelIndex rest = m_model->index(m_model->rowCount(category) - 1, 0, category);
  const QString& robot = m_model->searchText(rest);
  return std::all_of(m_words.begin(), m_words.end(),
                     [&robot](const QString& word) { return robot.contains(word); });
}

bool VariablesFilter::filterAcceptsRow(int row, const QModelIndex& parent) const {
  const QModelIndex index = m_model->index(row, 0, parent);
  const VariablesModel::Kind kind = m_model->kindOf(index);
  if (kind == VariablesModel::Kind::Rest) return foldsIn(parent);
  if (kind == VariablesModel::Kind::Variable) {
    const bool folded = m_model->wasNeverSet(index) && foldsIn(parent) &&
                        !m_unfolded.contains(parent.data(VariablesModel::PathRole).toString());
    return !folded && (!isFiltering() || accepts(index));
  }
  if (!isFiltering()) return true;
  for (int child = 0; child < m_model->rowCount(index); ++child) {
    if (filterAcceptsRow(child, index)) return true;
  }
  return false;
}

bool VariablesFilter::lessThan(const QModelIndex& left, const QModelIndex& right) const {
  // Robots and categories keep their order whatever their variables are sorted by.
  const bool rows = m_model->kindOf(left) == VariablesModel::Kind::Variable ||
                    m_model->kindOf(left) == VariablesModel::Kind::Rest;
  if (!rows) {
    return sortOrder() == Qt::AscendingOrder ? left.row() < right.row() : left.row() > right.row();
  }
  // The row that stands for the rest is the last one in both orders.
  if (m_model->kindOf(left) == VariablesModel::Kind::Rest) {
    return sortOrder() == Qt::DescendingOrder;
  }
  if (m_model->kindOf(right) == VariablesModel::Kind::Rest) {
    return sortOrder() == Qt::AscendingOrder;
  }
  const QVariant a = left.data(VariablesModel::SortRole);
  const QVariant b = right.data(VariablesModel::SortRole);
  if (a.userType() == QMetaType::Double && b.userType() == QMetaType::Double) {
    const double x = a.toDouble(), y = b.toDouble();
    // A strict order needs a place for NaN: below all numbers.
    if (std::isnan(x) || std::isnan(y)) return std::isnan(x) && !std::isnan(y);
    return x < y;
  }
  if (a.isNull() || b.isNull()) return a.isNull() && !b.isNull();
  return QString::localeAwareCompare(a.toString(), b.toString()) < 0;
}

}  // namespace pitchboard::ui
