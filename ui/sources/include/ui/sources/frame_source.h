// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where frames and rows come from: a simulated match, live robots, a recorded session. Field,
// cards, inspector, plots and timeline take them from here and do not know which kind it is. UI
// thread only.

#include <QDateTime>
#include <QObject>
#include <QString>
#include <memory>
#include <optional>
#include <vector>

#include <robotlink/frame/match_event.h>
#include <robotlink/frame/match_frame.h>

namespace pitchboard::telemetry {
class SeriesStore;
}

namespace pitchboard::ui {

class Playback;

using FramePtr = std::shared_ptr<const link::MatchFrame>;

enum class SourceKind { Simulate, Live, Replay };

class FrameSource : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;

  virtual SourceKind kind() const = 0;
  /// The newest frame; null while there is none.
  virtual FramePtr frame() const = 0;
  /// Rows of everything that the source knows; null while there is nothing. Another object after
  /// `restarted`.
  virtual std::shared_ptr<const telemetry::SeriesStore> series() const = 0;
  /// What to say in place of robots while there are none: a sentence or two.
  virtual QString emptyText() const = 0;
  /// The moment at or before this time (s), from what the source remembers; null when it does not.
  virtual FramePtr frameAt(double /*time*/) const { return nullptr; }
  /// Time of day at second 0, where the source has one.
  virtual std::optional<QDateTime> clock() const { return {}; }
  /// What moves in a recording; null for a source that goes on by itself.
  virtual Playback* playback() const { return nullptr; }

 signals:
  void frameReceived(const pitchboard::ui::FramePtr& frame);
  /// From the next frame on these robots have other keys; what is known of them goes on.
  void robotsRenamed(const std::vector<pitchboard::Renaming>& renamings);
  void eventsReceived(const std::vector<pitchboard::link::MatchEvent>& events);
  void logReceived(const std::vector<pitchboard::LogLine>& lines);
  /// What a recording holds of events, once for each recording.
  void eventsRecorded(const std::vector<pitchboard::link::MatchEvent>& events);
  /// Another match or session, or none: what was remembered of the old one is void.
  void restarted();
  /// Rows of a recording that were asked for are in memory now: the same range looks different.
  void rowsCame();
  /// The source goes on from this moment (s) of its past. Its rows later than that are gone, and
  /// whatever else was remembered of later times must go as well: it has not happened.
  void rewound(double time);
};

}  // namespace pitchboard::ui
