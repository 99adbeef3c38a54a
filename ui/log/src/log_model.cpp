// SPDX-License-Identifier: GPL-3.0-or-later
#include "log_model.h"

#include <QFont>
#include <algorithm>
#include <iterator>
#include <utility>

#include <ui/base/theme.h>
#include <ui/base/time_axis.h>

namespace pitchboard::ui {
namespace {

bool isStartLine(const LogLine& line) {
  return line.level == LogLevel::Debug;
}

}  // namespace

LogModel::Part& LogModel::partOf(const Line& line) {
  static const std::string events = "\n";  // no origin has this name
  return m_parts[line.isEvent ? events : line.origin];
}

void LogModel::append(const std::vector<LogLine>& lines, const std::optional<QDateTime>& clock,
                      const SourceKind* of, bool events) {
  const std::size_t kept = std::min(lines.size(), maxLines);
  m_dropped += lines.size() - kept;
  std::vector<Line> made;
  for (std::size_t i = lines.size() - kept; i < lines.size(); ++i) {
    made.push_back({lines[i], clock, of, events});
  }
  insert(std::move(made));
  makeRoom();
}

void LogModel::insert(std::vector<Line> lines) {
  if (lines.empty()) return;
  const int first = static_cast<int>(m_lines.size());
  beginInsertRows({}, first, first + static_cast<int>(lines.size()) - 1);
  for (Line& line : lines) {
    line.part = &partOf(line);
    ++line.part->lines;
    if (isStartLine(line)) ++m_startLines;
    m_lines.push_back(std::move(line));
  }
  endInsertRows();
}

void LogModel::makeRoom() {
  if (m_lines.size() <= maxLines + surplusLines) return;
  std::erase_if(m_parts, [](const auto& part) { return part.second.lines == 0; });
  const std::size_t share = maxLines / (2 * m_parts.size());
  for (auto& [name, part] : m_parts) part.mayGo = part.lines - std::min(part.lines, share);
  const std::size_t surplus = m_lines.size() - maxLines;
  std::size_t left = surplus;
  forgetWhere([&left](const Line& line) {
    if (left == 0 || line.part->mayGo == 0) return false;
    --line.part->mayGo;
    --left;
    return true;
  });
  m_dropped += surplus;
}

/// Asks about every line in order. Lines that are neighbours go together, because whoever shows the
/// list pays for each removal.
void LogModel::forgetWhere(const std::function<bool(const Line&)>& unwanted) {
  std::vector<std::pair<std::ptrdiff_t, std::ptrdiff_t>> runs;
  for (std::ptrdiff_t row = 0; row < std::ssize(m_lines); ++row) {
    if (!unwanted(m_lines[static_cast<std::size_t>(row)])) continue;
    if (runs.empty() || runs.back().second != row) runs.emplace_back(row, row);
    runs.back().second = row + 1;
  }
  for (auto run = runs.rbegin(); run != runs.rend(); ++run) {
    forget(m_lines.begin() + run->first, m_lines.begin() + run->second);
  }
}

void LogModel::forget(std::deque<Line>::iterator first, std::deque<Line>::iterator last) {
  const int row = static_cast<int>(first - m_lines.begin());
  beginRemoveRows({}, row, row + static_cast<int>(last - first) - 1);
  for (auto line = first; line != last; ++line) {
    --line->part->lines;
    if (isStartLine(*line)) --m_startLines;
  }
  m_lines.erase(first, last);
  endRemoveRows();
}

void LogModel::divide(const SourceKind& of, const QString& text) {
  bool any = false;
  for (Line& line : m_lines) {
    if (line.of != &of) continue;
    line.of = nullptr;
    any = true;
  }
  if (!any) return;
  emit dataChanged(index(0, 0), index(rowCount() - 1, columns - 1), {Qt::ForegroundRole});
  Line divider;
  divider.text = text.toStdString();
  divider.level = LogLevel::Unknown;
  divider.isEvent = divider.isDivider = true;
  insert({divider});
  makeRoom();
}

void LogModel::setTimesOfDay(bool on) {
  if (on == m_timesOfDay) return;
  m_timesOfDay = on;
  if (!m_lines.empty()) emit dataChanged(index(0, Time), index(rowCount() - 1, Time));
}

void LogModel::setMoment(const SourceKind& shown, std::optional<double> time) {
  if (&shown == m_shown && time == m_moment) return;
  std::vector<bool> before;
  before.reserve(m_lines.size());
  for (const Line& line : m_lines) before.push_back(isLater(line));
  m_shown = &shown;
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

void LogModel::strike(const SourceKind& of, std::uint32_t cause) {
  for (int row = rowCount() - 1; row >= 0; --row) {
    Line& line = m_lines[static_cast<std::size_t>(row)];
    if (line.of != &of || line.cause != cause || std::exchange(line.undone, true)) continue;
    emit dataChanged(index(row, 0), index(row, columns - 1), {Qt::FontRole, Qt::ForegroundRole});
  }
}

void LogModel::clear() {
  beginResetModel();
  m_lines.clear();
  m_parts.clear();
  m_dropped = 0;
  m_startLines = 0;
  endResetModel();
}

void LogModel::rewind(const SourceKind& of, double time) {
  forgetWhere([&of, time](const Line& line) { return line.of == &of && line.time > time; });
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
  if (line.isDivider) {
    if (role == Qt::BackgroundRole) return theme().button;
    if (role == Qt::ForegroundRole) return theme().secondaryText;
    if (role == Qt::FontRole) return themeFont(TypeRole::Secondary, true);
    if (role == Qt::DisplayRole && index.column() != Text) return {};
  }
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
  if (role == recordedRole) return line.of != nullptr && !line.of->hasPresent;
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
  if (!m_recordedShown &&
      sourceModel()->index(row, 0, parent).data(LogModel::recordedRole).toBool()) {
    return false;
  }
  if (start ? !m_startLinesShown : level != LogLevel::Unknown && level < m_least) return false;
  return TextFilter::filterAcceptsRow(row, parent);
}

}  // namespace pitchboard::ui
