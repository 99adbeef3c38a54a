// SPDX-License-Identifier: GPL-3.0-or-later
#include "log_model.h"

#include <QFont>
#include <algorithm>
#include <utility>

#include <ui/base/theme.h>
#include <ui/base/time_axis.h>

namespace pitchboard::ui {
namespace {

bool isStartLine(const LogLine& line) {
  return line.level == LogLevel::Debug;
}

}  // namespace

void LogModel::append(const std::vector<LogLine>& lines, const std::optional<QDateTime>& clock,
                      std::optional<SourceKind> of) {
  const std::size_t kept = std::min(lines.size(), maxLines);
  m_dropped += lines.size() - kept;
  if (kept == 0) return;
  const std::size_t surplus =
      m_lines.size() + kept > maxLines ? m_lines.size() + kept - maxLines : 0;
  if (surplus > 0) {
    const auto end = m_lines.begin() + static_cast<std::ptrdiff_t>(surplus);
    beginRemoveRows({}, 0, static_cast<int>(surplus) - 1);
    m_startLines -= static_cast<int>(std::count_if(m_lines.begin(), end, isStartLine));
    m_lines.erase(m_lines.begin(), end);
    m_dropped += surplus;
    endRemoveRows();
  }
  const int first = static_cast<int>(m_lines.size());
  beginInsertRows({}, first, first + static_cast<int>(kept) - 1);
  for (std::size_t i = lines.size() - kept; i < lines.size(); ++i) {
    m_lines.push_back({lines[i], clock, of});
  }
  m_startLines += static_cast<int>(
      std::count_if(lines.end() - static_cast<std::ptrdiff_t>(kept), lines.end(), isStartLine));
  endInsertRows();
}

void LogModel::setTimesOfDay(bool on) {
  if (on == m_timesOfDay) return;
  m_timesOfDay = on;
  if (!m_lines.empty()) emit dataChanged(index(0, Time), index(rowCount() - 1, Time));
}

void LogModel::setMoment(SourceKind shown, std::optional<double> time) {
  if (shown == m_shown && time == m_moment) return;
  std::vector<bool> before;
  before.reserve(m_lines.size());
  for (const Line& line : m_lines) before.push_back(isLater(line));
  m_shown = shown;
  m_moment = time;
  // While the past is played that happens at every frame: only what differs is told.
  int first = -1, last = -1;
  for (int row = 0; row < rowCount(); ++row) {
    const auto i = static_cast<std::size_t>(row);
    if (isLater(m_lines[i]) == before[i]) continue;
    if (first < 0) first = row;
    last = row;
  }
  if (first >= 0) emit dataChanged(index(first, 0), index(last, columns - 1), {Qt::ForegroundRole});
}

int LogModel::rowAtMoment() const {
  for (int row = rowCount() - 1; row >= 0; --row) {
    const Line& line = m_lines[static_cast<std::size_t>(row)];
    if (line.of == m_shown && !isLater(line)) return row;
  }
  return -1;
}

void LogModel::strike(SourceKind of, std::uint32_t cause) {
  for (int row = rowCount() - 1; row >= 0; --row) {
    Line& line = m_lines[static_cast<std::size_t>(row)];
    if (line.of != of || line.cause != cause || std::exchange(line.undone, true)) continue;
    emit dataChanged(index(row, 0), index(row, columns - 1), {Qt::FontRole, Qt::ForegroundRole});
  }
}

void LogModel::clear() {
  beginResetModel();
  m_lines.clear();
  m_dropped = 0;
  m_startLines = 0;
  endResetModel();
}

void LogModel::rewind(SourceKind of, double time) {
  for (int row = rowCount() - 1; row >= 0; --row) {
    const auto line = m_lines.begin() + row;
    if (line->of != of || line->time <= time) continue;
    beginRemoveRows({}, row, row);
    if (isStartLine(*line)) --m_startLines;
    m_lines.erase(line);
    endRemoveRows();
  }
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
  if (role == timeRole) return line.time;
  if (role == shownRole) return line.of == m_shown;
  if (role == levelRole) return static_cast<int>(line.level);
  if (role == Qt::ToolTipRole && index.column() == Text) return QString::fromStdString(line.text);
  if (role == Qt::FontRole && line.undone && index.column() == Text) {
    QFont struck = themeFont(TypeRole::Body);
    struck.setStrikeOut(true);
    return struck;
  }
  if (role == Qt::ForegroundRole) {
    if (isLater(line) || line.undone) return theme().disabledText;
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

bool LogFilter::filterAcceptsRow(int row, const QModelIndex& parent) const {
  const auto level =
      static_cast<LogLevel>(sourceModel()->index(row, 0, parent).data(LogModel::levelRole).toInt());
  const bool start = level == LogLevel::Debug;
  if (start ? !m_startLinesShown : level != LogLevel::Unknown && level < m_least) return false;
  return WordsFilter::filterAcceptsRow(row, parent);
}

}  // namespace pitchboard::ui
