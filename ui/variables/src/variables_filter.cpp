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

void VariablesFilter::setWords(const QString& text) {
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

void VariablesFilter::update() {
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
    for (int h = 0; h < rowCount(group); ++h) count += rowCount(index(h, 0, group));
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

bool VariablesFilter::filterAcceptsRow(int row, const QModelIndex& parent) const {
  if (!isFiltering()) return true;
  const QModelIndex index = m_model->index(row, 0, parent);
  if (m_model->kindOf(index) == VariablesModel::Kind::Variable) return accepts(index);
  for (int child = 0; child < m_model->rowCount(index); ++child) {
    if (filterAcceptsRow(child, index)) return true;
  }
  return false;
}

bool VariablesFilter::lessThan(const QModelIndex& left, const QModelIndex& right) const {
  // Robots and categories keep their order whatever their variables are sorted by.
  if (m_model->kindOf(left) != VariablesModel::Kind::Variable) {
    return sortOrder() == Qt::AscendingOrder ? left.row() < right.row() : left.row() > right.row();
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
