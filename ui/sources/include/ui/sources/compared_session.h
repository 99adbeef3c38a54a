// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A session that is compared with the source that is shown: its robots are drawn on the field, its
// events in a row of the timeline, its curves in the same plots. The two can be aligned by time
// (live recordings by their beginnings, because second 0 is arbitrary there), by the kick-off, by
// an event chosen in each, or manually. Owned by ComparedSessions. UI thread only; the file is read
// on other threads.

#include <QObject>
#include <optional>

#include <ui/sources/replay_controller.h>

namespace pitchboard::ui {

class EventCollector;
class EventList;
class ShownMoment;

class ComparedSession : public QObject {
  Q_OBJECT
 public:
  /// `id` is never given twice.
  ComparedSession(quint64 id, ShownMoment* shown, QObject* parent);

  /// Opens a file; returns immediately. opened() or failed() follows.
  void open(const QString& path);
  QString path() const { return m_file.path(); }
  /// Returns the file's name without folder and suffix.
  QString name() const;
  /// Returns its mark and name, "′₂ match", as in lists.
  QString markedName() const;
  quint64 id() const { return m_id; }
  /// The number of its colour and mark (session_mark.h); it keeps them until it is closed.
  int number() const { return m_number; }
  void setNumber(int number) { m_number = number; }
  void setMemoryBudget(std::size_t bytes);
  /// Returns the memory that its rows take, or may take while they are being read; bytes.
  std::size_t memoryUse() const;

  const EventList* events() const;
  /// The rows with the times of the compared session; null before it is open.
  std::shared_ptr<const telemetry::SeriesStore> series() const { return m_file.series(); }
  /// Returns whether nothing of the file is still being read into memory.
  bool isRead() const { return m_file.loaded() == 1.0; }
  /// Its first and last moment, in its own time.
  std::optional<telemetry::TimeRange> available() const { return m_file.available(); }
  /// Time of its second 0 on the timeline of the source that is shown, s.
  double offset() const { return m_offset; }
  void setOffset(double seconds);
  // Choose an event of the source that is shown (`here`, s) and one of the compared session
  // (`there`, s of that session). Once both are chosen, they are aligned.
  void alignHere(double here);
  void alignThere(double there);
  std::optional<double> here() const { return m_here; }
  std::optional<double> there() const { return m_there; }
  /// Returns the offset at which the first kick-offs of both are at the same time, s; nothing if
  /// one of them has none.
  std::optional<double> offsetByKickOff() const;
  void alignByKickOff();
  /// Aligns second 0 of both, or the beginnings of live recordings.
  void alignByTime();
  bool isAlignedByTime() const { return m_offset == offsetByTime(); }

  bool isOnField() const { return m_isOnField; }
  void setOnField(bool on);
  bool isInPlots() const { return m_isInPlots; }
  void setInPlots(bool on);

  /// "match · +3.20 s", with what is still to be chosen.
  QString caption() const;

 signals:
  void opened();
  /// It was aligned, or is shown elsewhere than before.
  void changed();
  /// series() has more rows.
  void rowsCame();
  void failed(const QString& sentence);
  /// The frame that belongs to the moment shown; null if there is none, or none is wanted.
  void momentReached(const pitchboard::ui::FramePtr& frame);

 private:
  double offsetByTime() const;
  void align();
  void showMoment();

  quint64 m_id;
  int m_number = 1;
  ShownMoment* m_shown;
  ReplayController m_file;
  std::size_t m_budget = 0;
  EventCollector* m_events;
  double m_offset = 0.0;
  std::optional<double> m_here, m_there;
  bool m_isOnField = true, m_isInPlots = true;
};

}  // namespace pitchboard::ui
