// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Events of one source in order of time, for the timeline and for tables. Bounded: the oldest
// leave first, bookmarks last of all. UI thread only.

#include <QAbstractTableModel>
#include <QDateTime>
#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include <robotlink/frame/match_event.h>
#include <ui/sources/event_filter.h>

namespace pitchboard::ui {

class EventList : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { Time, What, Note, columns };
  static constexpr std::size_t maxEvents = 20'000;
  static constexpr int maxNote = 200;  ///< characters

  explicit EventList(QObject* parent = nullptr, std::size_t most = maxEvents);
  /// Asked when a time is written: the time of day at second 0, if times are written so.
  void setClock(std::function<std::optional<QDateTime>()> clock);
  /// The clock gives something else now.
  void writeTimesAnew();

  /// In its place by time, behind those of the same time. Returns its row. A time that is not
  /// finite is not taken: -1. Nor is an Undone: the events before that it takes back leave.
  int add(link::MatchEvent event);
  /// The same for many, with one reset of the model when they are not simply later ones.
  void add(std::vector<link::MatchEvent> events);
  /// The source was put back: what came after this time has not happened.
  void rewind(double time);
  void clear();
  void removeEvent(int row);
  /// Only a bookmark has a note of one's own; others are left alone.
  void setNote(int row, const QString& note);

  const std::deque<link::MatchEvent>& events() const { return m_events; }
  const link::MatchEvent& event(int row) const { return m_events[static_cast<std::size_t>(row)]; }
  /// Row of the first event after / last event before this time, of those that the filter shows.
  std::optional<int> next(double time, const EventFilter& filter = {}) const;
  std::optional<int> previous(double time, const EventFilter& filter = {}) const;
  /// Events that had to leave.
  std::size_t dropped() const { return m_dropped; }
  /// Grows with every change, for whoever caches what it draws.
  std::uint64_t revision() const { return m_revision; }

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  bool setData(const QModelIndex& index, const QVariant& value, int role) override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 signals:
  void changed();

 private:
  void makeRoom();
  void removeCause(std::uint32_t cause);
  void touch();

  std::deque<link::MatchEvent> m_events;
  std::function<std::optional<QDateTime>()> m_clock;
  std::size_t m_most;
  std::size_t m_dropped = 0;
  std::uint64_t m_revision = 0;
};

}  // namespace pitchboard::ui
