// SPDX-License-Identifier: GPL-3.0-or-later
#include "plays_model.h"

#include <ui/base/robot_text.h>
#include <ui/base/theme.h>
#include <ui/base/time_axis.h>

namespace pitchboard::ui {

void PlaysModel::show(std::vector<link::PlayEvent> plays, const std::optional<QDateTime>& clock) {
  if (plays == m_plays && clock == m_clock) return;  // keeps the selection
  beginResetModel();
  m_plays = std::move(plays);
  m_clock = clock;
  endResetModel();
}

int PlaysModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(m_plays.size());
}

int PlaysModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : columns;
}

QString PlaysModel::text(const link::PlayEvent& play, int column) const {
  switch (column) {
    case Time:
      return momentText(play.time, 1, m_clock);
    case Kind:
      return capitalised(labelOf(play.kind));
    case Robot:
      return play.name.empty() ? capitalised(info(play.team).name)
                               : QString::fromStdString(play.name);
    case What:
      return QString::fromStdString(sentenceOf(play));
    default:
      return {};
  }
}

QVariant PlaysModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || index.row() >= rowCount()) return {};
  const link::PlayEvent& play = at(index.row());
  if (role == Qt::DisplayRole) return text(play, index.column());
  if (role == sortRole) {
    return index.column() == Time ? QVariant(play.time) : QVariant(text(play, index.column()));
  }
  if (role == Qt::ToolTipRole && play.sigma > 0.0) {
    return QStringLiteral("Robots report places here to about ±%1 m")
        .arg(QString::number(play.sigma, 'f', 2));
  }
  if (role == Qt::ForegroundRole && index.column() == Time) return theme().secondaryText;
  return {};
}

QVariant PlaysModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
  const QString names[] = {QStringLiteral("Time"), QStringLiteral("Kind"), QStringLiteral("Robot"),
                           QStringLiteral("What")};
  return section >= 0 && section < columns ? names[section] : QVariant();
}

bool PlaysFilter::filterAcceptsRow(int row, const QModelIndex& parent) const {
  const link::PlayEvent& play = static_cast<const PlaysModel*>(sourceModel())->at(row);
  if (m_kind && play.kind != *m_kind) return false;
  if (m_team && play.team != *m_team) return false;
  if (!m_robot.empty() && play.name != m_robot && play.otherName != m_robot) return false;
  return TextFilter::filterAcceptsRow(row, parent);
}

}  // namespace pitchboard::ui
