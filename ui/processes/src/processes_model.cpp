// SPDX-License-Identifier: GPL-3.0-or-later
#include "processes_model.h"

#include <QColor>
#include <algorithm>

#include <ui/base/robot_words.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

QString stateText(const link::ChildStatus& status) {
  const QString detail = QString::fromStdString(status.detail);
  const auto with = [&detail](const QString& word) {
    return detail.isEmpty() ? word : word + QStringLiteral(" (") + detail + QLatin1Char(')');
  };
  switch (status.state) {
    case link::ChildState::Running:
      return QStringLiteral("running");
    case link::ChildState::Ended:
      return with(QStringLiteral("ended"));
    case link::ChildState::Failed:
      return with(QStringLiteral("failed"));
  }
  return {};
}

}  // namespace

void ProcessesModel::update(const link::MatchFrame& frame) {
  std::vector<Row> rows;
  for (const link::RobotFrame& robot : frame.robots) {
    const std::size_t first = rows.size();
    for (const link::ChildStatus& child : robot.processes()) {
      const auto same = std::find_if(
          rows.begin() + static_cast<std::ptrdiff_t>(first), rows.end(),
          [&child](const Row& row) { return row.status.spec.name == child.spec.name; });
      if (same != rows.end())
        same->status = child;
      else
        rows.push_back({child, robotName(robot.identity)});
    }
  }
  const auto sameKey = [](const Row& a, const Row& b) {
    return a.status.spec.robot == b.status.spec.robot && a.status.spec.name == b.status.spec.name;
  };
  if (!std::equal(rows.begin(), rows.end(), m_rows.begin(), m_rows.end(), sameKey)) {
    beginResetModel();
    m_rows = std::move(rows);
    endResetModel();
    return;
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i] == m_rows[i]) continue;
    m_rows[i] = std::move(rows[i]);
    const int row = static_cast<int>(i);
    emit dataChanged(index(row, 0), index(row, columns - 1));
  }
}

void ProcessesModel::clear() {
  beginResetModel();
  m_rows.clear();
  endResetModel();
}

RobotId ProcessesModel::robotAt(int row) const {
  return m_rows[static_cast<std::size_t>(row)].status.spec.robot;
}

int ProcessesModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(m_rows.size());
}

int ProcessesModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : columns;
}

QVariant ProcessesModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid()) return {};
  const Row& row = m_rows[static_cast<std::size_t>(index.row())];
  if (role == Qt::DisplayRole || role == Qt::ToolTipRole) {
    switch (index.column()) {
      case Robot:
        return row.robot;
      case Process:
        return QString::fromStdString(row.status.spec.name);
      case Pid:
        return QString::number(row.status.pid);
      case State:
        return stateText(row.status);
      case LastOutput:
        return QString::fromStdString(row.status.lastOutput);
      default:
        return {};
    }
  }
  if (role == Qt::ForegroundRole && index.column() == State) {
    if (row.status.state == link::ChildState::Failed) return theme().errorText;
    if (row.status.state == link::ChildState::Ended) return theme().secondaryText;
  }
  return {};
}

QVariant ProcessesModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal) return {};
  if (role != Qt::DisplayRole) return {};
  const QString names[] = {QStringLiteral("Robot"), QStringLiteral("Process"),
                           QStringLiteral("PID"), QStringLiteral("State"),
                           QStringLiteral("Last output")};
  return section >= 0 && section < columns ? names[section] : QVariant();
}

}  // namespace pitchboard::ui
