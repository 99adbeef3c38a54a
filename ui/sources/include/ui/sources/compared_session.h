// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A second session that is compared with the source that is shown: its robots are drawn on the
// field, its events in the second row of the timeline, its curves in the same plots. The two can be
// aligned by time (live recordings by their beginnings, because second 0 is arbitrary there), by an
// event chosen in each, or manually. UI thread only; the file is read on other threads.

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
  ComparedSession(ShownMoment* shown, QObject* parent);

  /// Opens a file; returns immediately. changed() or failed() follows; after a failure the previous
  /// session is still compared.
  void open(const QString& path);
  void stop();
  bool isOn() const { return m_file.isOpen(); }
  QString path() const { return m_file.path(); }
  void setMemoryBudget(std::size_t bytes) { m_file.setMemoryBudget(bytes); }

  /// Null while no session is compared.
  const EventList* events() const;
  /// The rows with the times of the compared session; null while there is none.
  std::shared_ptr<const telemetry::SeriesStore> series() const { return m_file.series(); }
  /// Time of its second 0 on the timeline of the source that is shown, s.
  double offset() const { return m_offset; }
  void setOffset(double seconds);
  // Choose an event of the source that is shown (`here`, s) and one of the compared session
  // (`there`, s of that session). Once both are chosen, they are aligned.
  void alignHere(double here);
  void alignThere(double there);
  std::optional<double> here() const { return m_here; }
  std::optional<double> there() const { return m_there; }
  /// Aligns second 0 of both, or the beginnings of live recordings.
  void alignByTime();
  bool isAlignedByTime() const { return m_offset == offsetByTime(); }
  /// "match.mcap · +3.20 s"
  QString caption() const;

 signals:
  /// A session was opened, closed or aligned.
  void changed();
  /// series() has more rows.
  void rowsCame();
  void failed(const QString& sentence);
  /// The frame that belongs to the moment shown; null if there is none.
  void momentReached(const pitchboard::ui::FramePtr& frame);

 private:
  double offsetByTime() const;
  void align();
  void showMoment();

  ShownMoment* m_shown;
  ReplayController m_file;
  EventCollector* m_events;
  double m_offset = 0.0;
  std::optional<double> m_here, m_there;
};

}  // namespace pitchboard::ui
