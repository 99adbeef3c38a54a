// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A source of frames and rows: a simulated match, live robots, or a recorded session. Field, cards,
// variables, plots and timeline use this interface and what a source states about itself; which
// source it is they do not know. UI thread only.

#include <QDateTime>
#include <QObject>
#include <QString>
#include <memory>
#include <optional>
#include <vector>

#include <robotlink/frame/match_event.h>
#include <robotlink/frame/match_frame.h>
#include <telemetry/series/series_store.h>

namespace pitchboard::ui {

using FramePtr = std::shared_ptr<const link::MatchFrame>;

/// What a source states about itself. A further kind of source is a row below.
struct SourceKind {
  const char* name = "";            ///< of its button in the tool bar
  const char* tip = "";             ///< of its button
  bool canBeEdited = false;         ///< the user can change its robots, ball and game
  bool hasPresent = true;           ///< it goes on by itself; otherwise it is a recording
  bool hasPast = true;              ///< earlier moments can be shown
  bool mayBeContinued = false;      ///< it can go on from an earlier moment
  const char* whyNotEditable = "";  ///< a sentence about its variables; empty: they can be edited
  const char* windowKey = "";       ///< where settings keep how much of it plots show
  double window = 15.0;             ///< s that plots show at first
  double sparkline = 15.0;          ///< s that the small curves of variables show
  bool operator==(const SourceKind&) const = default;

  static const SourceKind Simulate, Live, Replay;
};

inline constexpr SourceKind SourceKind::Simulate{.name = "Simulate",
                                                 .tip = "Robots simulated on this computer",
                                                 .canBeEdited = true,
                                                 .mayBeContinued = true,
                                                 .windowKey = "plots/window"};
// Robots send rarely.
inline constexpr SourceKind SourceKind::Live{
    .name = "Live",
    .tip = "Robots and referee received from the network. Nothing is sent to robots",
    .whyNotEditable = "Live values are read-only: nothing is ever sent to robots.",
    .windowKey = "plots/liveWindow",
    .window = 60.0,
    .sparkline = 60.0};
inline constexpr SourceKind SourceKind::Replay{
    .name = "Replay",
    .tip = "A recorded session",
    .hasPresent = false,
    .whyNotEditable = "Values of a recording are read-only.",
    .windowKey = "plots/replayWindow",
    .window = 60.0};

class FrameSource : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;

  virtual const SourceKind& kind() const = 0;
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
  /// Returns the range that can be shown; empty while there is none.
  virtual std::optional<telemetry::TimeRange> available() const {
    const auto rows = series();
    return rows ? rows->range() : std::nullopt;
  }
  // Of a recording only: the moment at which it stands, and another one; `frameReceived` follows.
  virtual double standsAt() const { return 0.0; }
  virtual void standAt(double /*time*/) {}

 signals:
  void frameReceived(const pitchboard::ui::FramePtr& frame);
  void eventsReceived(const std::vector<pitchboard::link::MatchEvent>& events);
  void logReceived(const std::vector<pitchboard::LogLine>& lines);
  /// All events of a recording, once for each recording.
  void eventsRecorded(const std::vector<pitchboard::link::MatchEvent>& events);
  /// There is another match or session, or none. Receivers forget what they kept of the old one.
  void restarted();
  /// More rows of a recording are in memory, so that a range may look different.
  void rowsCame();
  /// Rows were added to series(), with or without a frame; at most once in a beat of the display.
  void rowsAppended();
  /// The source continues from this earlier time (s). It has dropped its later rows; receivers drop
  /// whatever else they kept of later times.
  void rewound(double time);
};

}  // namespace pitchboard::ui
