// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The events of a source in order of time, for the timeline and for tables. If there are too many,
// the oldest are dropped, bookmarks last. UI thread only.

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

/// Returns whether it is a broken rule or a drawn note: who knows those lists them again.
inline bool isMadeByStudio(const link::MatchEvent& event) {
  return event.kind == link::MatchEventKind::RuleBroken || event.kind == link::MatchEventKind::Note;
}

class EventList : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { Time, What, Note, columns };
  static constexpr std::size_t maxEvents = 20'000;
  static constexpr int maxNote = 200;  ///< characters

  explicit EventList(QObject* parent = nullptr, std::size_t most = maxEvents);
  /// `clock` returns the time of day at second 0, or nothing if times are shown in seconds.
  void setClock(std::function<std::optional<QDateTime>()> clock);
  /// Call it when the result of `clock` has changed.
  void writeTimesAnew();

  /// Inserts the event by time, after those of equal time, and returns its row. Returns -1 for a
  /// time that is not finite, and for an Undone event, which removes the events that it undoes.
  int add(link::MatchEvent event);
  /// Adds many events. Resets the model once if they are not all later than those in the list.
  void add(std::vector<link::MatchEvent> events);
  /// Puts these events in place of all others of their kind.
  void replace(link::MatchEventKind kind, std::vector<link::MatchEvent> events);
  /// Removes all events after this time, because the source continues from there.
  void rewind(double time);
  void clear();
  void removeEvent(int row);
  /// Sets the note of a bookmark; does nothing for other events.
  void setNote(int row, const QString& note);

  const std::deque<link::MatchEvent>& events() const { return m_events; }
  const link::MatchEvent& at(int row) const { return m_events[static_cast<std::size_t>(row)]; }
  // Return the row of the first event after, or the last event before, this time that passes the
  // filter.
  std::optional<int> next(double time, const EventFilter& filter = {}) const;
  std::optional<int> previous(double time, const EventFilter& filter = {}) const;
  /// Returns the number of events dropped because there were too many.
  std::size_t dropped() const { return m_dropped; }
  /// Increases with every change, for caches.
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
