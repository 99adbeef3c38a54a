// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A source of frames and rows: a simulated match, live robots, or a recorded session. Field, cards,
// variables, plots and timeline use this interface and do not know the kind of source. UI thread
// only.

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
  /// Returns the newest frame; null while there is none.
  virtual FramePtr frame() const = 0;
  /// Returns the rows of all variables; null while there are none. It is another object after
  /// `restarted`.
  virtual std::shared_ptr<const telemetry::SeriesStore> series() const = 0;
  /// Returns the text that is shown while there are no robots: a sentence or two.
  virtual QString emptyText() const = 0;
  /// Returns the frame at or before this time (s); null if the source does not have it in memory.
  virtual FramePtr frameAt(double /*time*/) const { return nullptr; }
  /// Returns the time of day at second 0; empty if unknown.
  virtual std::optional<QDateTime> clock() const { return {}; }
  /// Returns the playback of a recording; null if the source advances by itself.
  virtual Playback* playback() const { return nullptr; }

 signals:
  void frameReceived(const pitchboard::ui::FramePtr& frame);
  /// These robots have other keys from the next frame on.
  void robotsRenamed(const std::vector<pitchboard::Renaming>& renamings);
  void eventsReceived(const std::vector<pitchboard::link::MatchEvent>& events);
  void logReceived(const std::vector<pitchboard::LogLine>& lines);
  /// All events of a recording, once for each recording.
  void eventsRecorded(const std::vector<pitchboard::link::MatchEvent>& events);
  /// There is another match or session, or none. Receivers forget what they kept of the old one.
  void restarted();
  /// More rows of a recording are in memory, so that a range may look different.
  void rowsCame();
  /// The source continues from this earlier time (s). It has dropped its later rows; receivers drop
  /// whatever else they kept of later times.
  void rewound(double time);
};

}  // namespace pitchboard::ui
