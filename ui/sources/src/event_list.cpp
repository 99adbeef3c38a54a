// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/event_list.h>

#include <algorithm>
#include <cmath>

#include <ui/base/time_axis.h>

namespace pitchboard::ui {
namespace {

bool earlier(const TimelineEvent& a, const TimelineEvent& b) {
  return a.time < b.time;
}

}  // namespace

EventList::EventList(QObject* parent, std::size_t most)
    : QAbstractTableModel(parent), m_most(std::max<std::size_t>(most, 1)) {}

void EventList::touch() {
  ++m_revision;
  emit changed();
}

// A flood of kicks must not push out what a person wrote.
void EventList::makeRoom() {
  if (m_events.size() < m_most) return;
  auto oldest = std::find_if(m_events.begin(), m_events.end(), [](const TimelineEvent& event) {
    return event.type != EventType::Bookmark;
  });
  if (oldest == m_events.end()) oldest = m_events.begin();
  const int row = static_cast<int>(oldest - m_events.begin());
  beginRemoveRows({}, row, row);
  m_events.erase(oldest);
  ++m_dropped;
  endRemoveRows();
}

int EventList::add(TimelineEvent event) {
  if (!std::isfinite(event.time)) return -1;
  event.text.truncate(maxNote);
  makeRoom();
  const auto place = std::upper_bound(m_events.begin(), m_events.end(), event, earlier);
  const int row = static_cast<int>(place - m_events.begin());
  beginInsertRows({}, row, row);
  m_events.insert(place, std::move(event));
  endInsertRows();
  touch();
  return row;
}

void EventList::add(std::vector<TimelineEvent> events) {
  std::erase_if(events, [](const TimelineEvent& event) { return !std::isfinite(event.time); });
  if (events.empty()) return;
  if (events.size() == 1) {
    add(std::move(events.front()));
    return;
  }
  beginResetModel();
  for (TimelineEvent& event : events) {
    event.text.truncate(maxNote);
    m_events.push_back(std::move(event));
  }
  std::stable_sort(m_events.begin(), m_events.end(), earlier);
  if (m_events.size() > m_most) {
    std::size_t surplus = m_events.size() - m_most;
    m_dropped += surplus;
    std::erase_if(m_events, [&surplus](const TimelineEvent& event) {
      return surplus > 0 && event.type != EventType::Bookmark && surplus-- > 0;
    });
    if (m_events.size() > m_most)
      m_events.erase(m_events.begin(), m_events.end() - static_cast<std::ptrdiff_t>(m_most));
  }
  endResetModel();
  touch();
}

void EventList::rewind(double time) {
  const auto from = std::find_if(m_events.begin(), m_events.end(),
                                 [time](const TimelineEvent& event) { return event.time > time; });
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

void EventList::setNote(int row, const QString& note) {
  setData(index(row, Note), note, Qt::EditRole);
}

std::optional<int> EventList::next(double time) const {
  const auto found =
      std::upper_bound(m_events.begin(), m_events.end(), TimelineEvent{time, {}, {}, {}}, earlier);
  if (found == m_events.end()) return {};
  return static_cast<int>(found - m_events.begin());
}

std::optional<int> EventList::previous(double time) const {
  const auto found =
      std::lower_bound(m_events.begin(), m_events.end(), TimelineEvent{time, {}, {}, {}}, earlier);
  if (found == m_events.begin()) return {};
  return static_cast<int>(found - m_events.begin()) - 1;
}

int EventList::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(m_events.size());
}

int EventList::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : columns;
}

QVariant EventList::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || index.row() >= rowCount()) return {};
  const TimelineEvent& e = event(index.row());
  if (role == Qt::ToolTipRole) return sentenceOf(e);
  if (role != Qt::DisplayRole && role != Qt::EditRole) return {};
  switch (index.column()) {
    case Time:
      return role == Qt::EditRole ? QVariant(e.time) : QVariant(momentText(e.time, 3));
    case What: {
      TimelineEvent bare = e;
      bare.text.clear();
      return sentenceOf(bare);
    }
    case Note:
      return e.text;
    default:
      return {};
  }
}

bool EventList::setData(const QModelIndex& index, const QVariant& value, int role) {
  if (!index.isValid() || index.row() >= rowCount() || index.column() != Note ||
      role != Qt::EditRole) {
    return false;
  }
  TimelineEvent& e = m_events[static_cast<std::size_t>(index.row())];
  if (e.type != EventType::Bookmark) return false;
  e.text = value.toString().simplified().left(maxNote);
  emit dataChanged(index, index);
  touch();
  return true;
}

Qt::ItemFlags EventList::flags(const QModelIndex& index) const {
  Qt::ItemFlags all = QAbstractTableModel::flags(index);
  if (index.isValid() && index.column() == Note && event(index.row()).type == EventType::Bookmark) {
    all |= Qt::ItemIsEditable;
  }
  return all;
}

QVariant EventList::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
  const QString names[] = {tr("Time"), tr("Event"), tr("Note")};
  return section >= 0 && section < columns ? names[section] : QVariant();
}

}  // namespace pitchboard::ui
