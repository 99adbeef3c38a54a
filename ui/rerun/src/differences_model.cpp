// SPDX-License-Identifier: GPL-3.0-or-later
#include "differences_model.h"

#include <algorithm>

#include <ui/base/robot_text.h>
#include <ui/base/time_axis.h>

namespace pitchboard::ui {

void DifferencesModel::show(std::vector<link::ComparedVariable> variables, const QString& before,
                            const std::optional<QDateTime>& clock) {
  beginResetModel();
  m_variables = std::move(variables);
  m_before = before;
  m_clock = clock;
  m_rows.clear();
  for (std::size_t i = 0; i < m_variables.size(); ++i) {
    for (std::size_t k = 0; k < m_variables[i].stretches.size(); ++k) m_rows.push_back({i, k});
  }
  std::ranges::stable_sort(m_rows, {}, [this](const Row& row) {
    return m_variables[row.variable].stretches[row.stretch].begin;
  });
  endResetModel();
}

std::uint64_t DifferencesModel::all() const {
  std::uint64_t count = 0;
  for (const link::ComparedVariable& one : m_variables) count += one.stretchCount;
  return count;
}

int DifferencesModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(m_rows.size());
}

int DifferencesModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : columns;
}

QString DifferencesModel::text(const Row& row, int column) const {
  const link::ComparedVariable& variable = m_variables[row.variable];
  const link::DifferentStretch& stretch = variable.stretches[row.stretch];
  const auto value = [&variable](double number) {
    return QString::fromStdString(link::valueText(variable.column, number));
  };
  switch (column) {
    case Time:
      return momentText(stretch.begin, 3, m_clock);
    case Variable:
      return QString::fromStdString(variable.column.name);
    case Before:
      return value(stretch.recorded);
    case Rerun:
      return value(stretch.rerun);
    case Duration:
      return QStringLiteral("%1 s").arg(numberText(stretch.end - stretch.begin, 2));
    case Largest:
      return variable.isCode() ? QString() : value(stretch.largest);
    default:
      return {};
  }
}

QVariant DifferencesModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || index.row() >= rowCount()) return {};
  const Row& row = m_rows[static_cast<std::size_t>(index.row())];
  switch (role) {
    case Qt::DisplayRole:
      return text(row, index.column());
    case Qt::ToolTipRole: {
      const link::ComparedVariable& variable = m_variables[row.variable];
      return QStringLiteral("%1 at %2: %3")
          .arg(text(row, Variable), text(row, Time),
               QString::fromStdString(
                   link::differenceText(variable, variable.stretches[row.stretch])));
    }
    case Qt::TextAlignmentRole:
      return index.column() == Duration ? QVariant(Qt::AlignRight | Qt::AlignVCenter) : QVariant();
    case timeRole:
      return m_variables[row.variable].stretches[row.stretch].begin;
    default:
      return {};
  }
}

QVariant DifferencesModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal) return {};
  if (role == Qt::TextAlignmentRole && section == Duration)
    return QVariant(Qt::AlignRight | Qt::AlignVCenter);
  if (role != Qt::DisplayRole) return {};
  switch (section) {
    case Time:
      return QStringLiteral("Time");
    case Variable:
      return QStringLiteral("Variable");
    case Before:
      return m_before;
    case Rerun:
      return QStringLiteral("Rerun");
    case Duration:
      return QStringLiteral("Duration");
    case Largest:
      return QStringLiteral("Largest difference");
    default:
      return {};
  }
}

}  // namespace pitchboard::ui
