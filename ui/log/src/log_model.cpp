// SPDX-License-Identifier: GPL-3.0-or-later
#include "log_model.h"

#include <algorithm>

#include <ui/base/theme.h>
#include <ui/base/time_axis.h>

namespace pitchboard::ui {

void LogModel::append(const std::vector<LogLine>& lines, const std::optional<QDateTime>& clock) {
  const std::size_t kept = std::min(lines.size(), maxLines);
  m_dropped += lines.size() - kept;
  if (kept == 0) return;
  const std::size_t surplus =
      m_lines.size() + kept > maxLines ? m_lines.size() + kept - maxLines : 0;
  if (surplus > 0) {
    beginRemoveRows({}, 0, static_cast<int>(surplus) - 1);
    m_lines.erase(m_lines.begin(), m_lines.begin() + static_cast<std::ptrdiff_t>(surplus));
    m_dropped += surplus;
    endRemoveRows();
  }
  const int first = static_cast<int>(m_lines.size());
  beginInsertRows({}, first, first + static_cast<int>(kept) - 1);
  for (std::size_t i = lines.size() - kept; i < lines.size(); ++i) {
    m_lines.push_back({lines[i], clock});
  }
  endInsertRows();
}

void LogModel::setTimesOfDay(bool on) {
  if (on == m_timesOfDay) return;
  m_timesOfDay = on;
  if (!m_lines.empty()) emit dataChanged(index(0, Time), index(rowCount() - 1, Time));
}

void LogModel::clear() {
  beginResetModel();
  m_lines.clear();
  m_dropped = 0;
  endResetModel();
}

int LogModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(m_lines.size());
}

int LogModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : columns;
}

QVariant LogModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid()) return {};
  const Line& line = m_lines[static_cast<std::size_t>(index.row())];
  if (role == Qt::DisplayRole) {
    switch (index.column()) {
      case Time:
        return momentText(line.time, 1, m_timesOfDay ? line.clock : std::nullopt);
      case Origin:
        return QString::fromStdString(line.origin);
      case Text:
        return QString::fromStdString(line.text);
      default:
        return {};
    }
  }
  if (role == Qt::ToolTipRole && index.column() == Text) return QString::fromStdString(line.text);
  if (role == Qt::ForegroundRole) {
    if (line.isWarning() && index.column() == Text) return theme().warningText;
    if (index.column() != Text) return theme().secondaryText;
  }
  return {};
}

QVariant LogModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
  const QString names[] = {QStringLiteral("Time"), QStringLiteral("Origin"),
                           QStringLiteral("Message")};
  return section >= 0 && section < columns ? names[section] : QVariant();
}

}  // namespace pitchboard::ui
