// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a match had played beyond the moment that it goes on from: a second, pale branch of timeline
// and plots, which can be drawn over the field or dropped. There is one at most; the next
// MatchMemory::continueFrom() replaces it, another match or too little memory ends it. UI thread
// only; times are those of the match.

#include <QObject>
#include <memory>

#include <ui/sources/match_memory.h>

namespace pitchboard::ui {

class EventList;
class SourceSwitch;
class Timeline;

class AbandonedFuture : public QObject {
  Q_OBJECT
 public:
  AbandonedFuture(MatchController* match, SourceSwitch* source, Timeline* timeline,
                  QObject* parent);

  /// There is one, and its match is shown.
  bool isOn() const;
  /// Where the match left it, and how far it goes, s.
  double begin() const { return m_left.from; }
  double end() const { return m_end; }
  /// Whether it is drawn over the field, too.
  bool isCompared() const { return m_compared; }
  void setCompared(bool on);
  void drop();

  /// Null while it is not on; before begin() the rows are those of the match.
  std::shared_ptr<const telemetry::SeriesStore> series() const;
  const EventList& events() const { return *m_events; }
  /// "abandoned at 04:48"
  QString caption() const;

 signals:
  void changed();
  /// The match has just left it.
  void began();
  /// Its moment at the time that is shown; null: none.
  void momentReached(const pitchboard::ui::FramePtr& frame);

 private:
  void showMoment();
  void keepBudget();

  MatchController* m_match;
  SourceSwitch* m_source;
  Timeline* m_timeline;
  EventList* m_events;
  MatchBranch m_left;
  double m_end = 0.0;
  bool m_compared = false;
  std::unique_ptr<link::RecordedFrames> m_frames;
};

}  // namespace pitchboard::ui
