// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/event_list.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include <ui/base/time_axis.h>

namespace pitchboard::ui {
namespace {

bool earlier(const link::MatchEvent& a, const link::MatchEvent& b) {
  return a.time < b.time;
}

bool isBookmark(const link::MatchEvent& event) {
  return event.kind == link::MatchEventKind::Bookmark;
}

/// What a person wrote or drew.
bool isPersonal(const link::MatchEvent& event) {
  return isBookmark(event) || event.kind == link::MatchEventKind::Note;
}

bool isBrokenRule(const link::MatchEvent& event) {
  return event.kind == link::MatchEventKind::RuleBroken;
}

void shorten(link::MatchEvent& event) {
  if (event.detail.size() <= EventList::maxNote) return;
  event.detail = QString::fromStdString(event.detail).left(EventList::maxNote).toStdString();
}

}  // namespace

EventList::EventList(QObject* parent, std::size_t most)
    : QAbstractTableModel(parent), m_most(std::max<std::size_t>(most, 1)) {}

void EventList::touch() {
  ++m_revision;
  emit changed();
}

// A flood of kicks must not push out what a person wrote, nor broken rules, which the panel Rules
// lists as well, what happened in the match.
void EventList::makeRoom() {
  if (m_events.size() < m_most) return;
  auto oldest = std::find_if(m_events.begin(), m_events.end(), isBrokenRule);
  if (oldest == m_events.end()) {
    oldest = std::find_if_not(m_events.begin(), m_events.end(), isPersonal);
  }
  if (oldest == m_events.end()) oldest = m_events.begin();
  const int row = static_cast<int>(oldest - m_events.begin());
  beginRemoveRows({}, row, row);
  m_events.erase(oldest);
  ++m_dropped;
  endRemoveRows();
}

int EventList::add(link::MatchEvent event) {
  if (!std::isfinite(event.time)) return -1;
  if (event.kind == link::MatchEventKind::Undone) {
    removeCause(event.cause);
    return -1;
  }
  shorten(event);
  makeRoom();
  const auto place = std::upper_bound(m_events.begin(), m_events.end(), event, earlier);
  const int row = static_cast<int>(place - m_events.begin());
  beginInsertRows({}, row, row);
  m_events.insert(place, std::move(event));
  endInsertRows();
  touch();
  return row;
}

void EventList::add(std::vector<link::MatchEvent> events) {
  std::erase_if(events, [](const link::MatchEvent& event) { return !std::isfinite(event.time); });
  if (events.empty()) return;
  if (events.size() == 1) {
    add(std::move(events.front()));
    return;
  }
  beginResetModel();
  for (link::MatchEvent& event : events) {
    if (event.kind == link::MatchEventKind::Undone) {
      std::erase_if(m_events, [&event](const auto& before) {
        return before.cause != 0 && before.cause == event.cause;
      });
      continue;
    }
    shorten(event);
    m_events.push_back(std::move(event));
  }
  std::stable_sort(m_events.begin(), m_events.end(), earlier);
  if (m_events.size() > m_most) {
    std::size_t surplus = m_events.size() - m_most;
    m_dropped += surplus;
    std::erase_if(m_events, [&surplus](const link::MatchEvent& event) {
      return surplus > 0 && isBrokenRule(event) && surplus-- > 0;
    });
    std::erase_if(m_events, [&surplus](const link::MatchEvent& event) {
      return surplus > 0 && !isPersonal(event) && surplus-- > 0;
    });
    if (m_events.size() > m_most)
      m_events.erase(m_events.begin(), m_events.end() - static_cast<std::ptrdiff_t>(m_most));
  }
  endResetModel();
  touch();
}

void EventList::replace(link::MatchEventKind kind, std::vector<link::MatchEvent> events) {
  const auto isOld = [kind](const link::MatchEvent& event) { return event.kind == kind; };
  if (events.empty() && std::ranges::none_of(m_events, isOld)) return;
  beginResetModel();
  std::erase_if(m_events, isOld);
  endResetModel();
  add(std::move(events));
  touch();
}

void EventList::rewind(double time) {
  const auto from =
      std::find_if(m_events.begin(), m_events.end(),
                   [time](const link::MatchEvent& event) { return event.time > time; });
  if (from == m_events.end()) return;
  beginRemoveRows({}, static_cast<int>(from - m_events.begin()), rowCount() - 1);
  m_events.erase(from, m_events.end());
  endRemoveRows();
  touch();
}

void EventList::clear() {
  beginResetModel();
  m_events.clear();
  m_dropped = 0;
  endResetModel();
  touch();
}

void EventList::removeEvent(int row) {
  if (row < 0 || row >= rowCount()) return;
  beginRemoveRows({}, row, row);
  m_events.erase(m_events.begin() + row);
  endRemoveRows();
  touch();
}

void EventList::removeCause(std::uint32_t cause) {
  for (int row = rowCount() - 1; row >= 0; --row) {
    if (cause != 0 && at(row).cause == cause) removeEvent(row);
  }
}

void EventList::setNote(int row, const QString& note) {
  setData(index(row, Note), note, Qt::EditRole);
}

std::optional<int> EventList::next(double time, const EventFilter& filter) const {
  link::MatchEvent moment;
  moment.time = time;
  const auto shown = [&filter](const link::MatchEvent& event) { return filter.shows(event); };
  const auto found = std::find_if(
      std::upper_bound(m_events.begin(), m_events.end(), moment, earlier), m_events.end(), shown);
  if (found == m_events.end()) return {};
  return static_cast<int>(found - m_events.begin());
}

std::optional<int> EventList::previous(double time, const EventFilter& filter) const {
  link::MatchEvent moment;
  moment.time = time;
  const auto before = std::lower_bound(m_events.begin(), m_events.end(), moment, earlier);
  const auto shown = [&filter](const link::MatchEvent& event) { return filter.shows(event); };
  const auto found = std::find_if(std::make_reverse_iterator(before), m_events.rend(), shown);
  if (found == m_events.rend()) return {};
  return static_cast<int>(m_events.rend() - found) - 1;
}

int EventList::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(m_events.size());
}

void EventList::setClock(std::function<std::optional<QDateTime>()> clock) {
  m_clock = std::move(clock);
}

void EventList::writeTimesAnew() {
  if (!m_events.empty()) emit dataChanged(index(0, Time), index(rowCount() - 1, Time));
}

int EventList::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : columns;
}

QVariant EventList::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || index.row() >= rowCount()) return {};
  const link::MatchEvent& e = at(index.row());
  if (role == Qt::ToolTipRole) return QString::fromStdString(sentenceOf(e));
  if (role != Qt::DisplayRole && role != Qt::EditRole) return {};
  switch (index.column()) {
    case Time:
      return role == Qt::EditRole
                 ? QVariant(e.time)
                 : QVariant(momentText(e.time, 3, m_clock ? m_clock() : std::nullopt));
    case What:
      return isBookmark(e) ? QString::fromUtf8(link::info(e.kind).predicate)
                           : QString::fromStdString(sentenceOf(e));
    case Note:
      return isBookmark(e) ? QString::fromStdString(e.detail) : QString();
    default:
      return {};
  }
}

bool EventList::setData(const QModelIndex& index, const QVariant& value, int role) {
  if (!index.isValid() || index.row() >= rowCount() || index.column() != Note ||
      role != Qt::EditRole) {
    return false;
  }
  link::MatchEvent& e = m_events[static_cast<std::size_t>(index.row())];
  if (!isBookmark(e)) return false;
  e.detail = value.toString().simplified().left(maxNote).toStdString();
  emit dataChanged(index, index);
  touch();
  return true;
}

Qt::ItemFlags EventList::flags(const QModelIndex& index) const {
  Qt::ItemFlags all = QAbstractTableModel::flags(index);
  if (index.isValid() && index.column() == Note && isBookmark(at(index.row()))) {
    all |= Qt::ItemIsEditable;
  }
  return all;
}

QVariant EventList::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
  const QString names[] = {QStringLiteral("Time"), QStringLiteral("Event"), QStringLiteral("Note")};
  return section >= 0 && section < columns ? names[section] : QVariant();
}

}  // namespace pitchboard::ui
