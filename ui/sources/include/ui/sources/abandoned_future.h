// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The abandoned future: what a match had already played after the moment from which the user let it
// continue. Timeline and plots show it as a second branch, which can be compared on the field or
// dropped. There is at most one; the next MatchMemory::continueFrom() replaces it, and another
// match or lack of memory removes it. UI thread only; times are those of the match.

#include <QObject>
#include <memory>

#include <ui/sources/match_memory.h>

namespace pitchboard::ui {

class EventList;
class ShownMoment;

class AbandonedFuture : public QObject {
  Q_OBJECT
 public:
  AbandonedFuture(MatchController* match, ShownMoment* shown, QObject* parent);

  /// Returns whether there is one and its match is shown.
  bool isOn() const;
  // The time from which the match continued, and the end of the abandoned future, s.
  double begin() const { return m_left.from; }
  double end() const { return m_end; }
  /// Returns whether it is also drawn on the field.
  bool isCompared() const { return m_compared; }
  void setCompared(bool on);
  void drop();

  /// Returns its rows, which before begin() are those of the match; null if it is not on.
  std::shared_ptr<const telemetry::SeriesStore> series() const;
  const EventList& events() const { return *m_events; }
  /// "abandoned at 04:48"
  QString caption() const;

 signals:
  void changed();
  /// There is a new abandoned future.
  void began();
  /// The frame at the time that is shown; null if there is none.
  void momentReached(const pitchboard::ui::FramePtr& frame);

 private:
  void showMoment();
  void keepBudget();

  MatchController* m_match;
  ShownMoment* m_shown;
  EventList* m_events;
  MatchBranch m_left;
  double m_end = 0.0;
  bool m_compared = false;
  std::unique_ptr<link::RecordedFrames> m_frames;
};

}  // namespace pitchboard::ui
