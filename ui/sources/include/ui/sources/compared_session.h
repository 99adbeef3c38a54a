// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A second session beside the one that is shown, whatever that is: its moments are for drawing over
// the field, its events stand in the timeline's second row, its curves in the same plots. Both are
// aligned by their times (live ones by their beginnings: each watch has a second 0 of its own), by
// an event chosen in each, or by hand. UI thread only; the file is read on threads of its own.

#include <QObject>
#include <optional>

#include <ui/sources/replay_controller.h>

namespace pitchboard::ui {

class EventCollector;
class EventList;
class Timeline;

class ComparedSession : public QObject {
  Q_OBJECT
 public:
  ComparedSession(Timeline* timeline, QObject* parent);

  /// Returns at once; changed() or failed() follows. On failure what was compared stays.
  void open(const QString& path);
  void stop();
  bool isOn() const { return m_file.isOpen(); }
  QString path() const { return m_file.path(); }
  void setMemoryBudget(std::size_t bytes) { m_file.setMemoryBudget(bytes); }

  /// Its events; null while nothing is compared.
  const EventList* events() const;
  /// Its rows, at its own times; null while nothing is compared.
  std::shared_ptr<const telemetry::SeriesStore> series() const { return m_file.series(); }
  /// Its second 0 on the timeline of what is shown, s.
  double offset() const { return m_offset; }
  void setOffset(double seconds);
  /// Chooses an event of what is shown (`here`, s) or of the compared session (`there`, s of its
  /// own). When both are chosen they stand at one moment.
  void alignHere(double here);
  void alignThere(double there);
  std::optional<double> here() const { return m_here; }
  std::optional<double> there() const { return m_there; }
  /// Second 0 of both at one moment again; of live sessions the beginnings.
  void alignByTime();
  bool isAlignedByTime() const { return m_offset == offsetByTime(); }
  /// "match.mcap · +3.20 s"
  QString caption() const;

 signals:
  /// On, off, or aligned in another way.
  void changed();
  /// There are more rows in series().
  void rowsCame();
  void failed(const QString& sentence);
  /// Its moment that belongs to what is shown; null: none.
  void momentReached(const pitchboard::ui::FramePtr& frame);

 private:
  double offsetByTime() const;
  void align();
  void showMoment();

  Timeline* m_timeline;
  ReplayController m_file;
  EventCollector* m_events;
  double m_offset = 0.0;
  std::optional<double> m_here, m_there;
};

}  // namespace pitchboard::ui
