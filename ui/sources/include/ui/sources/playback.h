// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A position in recorded time that moves by itself: plays at a chosen speed, steps, loops a range.
// Who shows the moment listens to positionChanged(). Seconds of the source. UI thread only.

#include <QElapsedTimer>
#include <QObject>
#include <optional>
#include <span>

#include <telemetry/series/series_store.h>

class QTimer;

namespace pitchboard::ui {

class Playback : public QObject {
  Q_OBJECT
 public:
  static constexpr double slowest = 0.1, fastest = 16.0;

  explicit Playback(QObject* parent = nullptr);

  /// What can be shown; it may grow and lose its beginning while playing. Empty: nothing.
  void setRange(std::optional<telemetry::TimeRange> range);
  std::optional<telemetry::TimeRange> range() const { return m_range; }
  /// Kept within the range.
  void seek(double time);
  double position() const { return m_position; }
  /// Plays this range over and over; nothing: to the end. A range without a length is not taken.
  void setLoop(std::optional<telemetry::TimeRange> loop);
  std::optional<telemetry::TimeRange> loop() const { return m_loop; }
  /// Ticks per second of what is shown, for step().
  void setTickRate(double perSecond);
  double tickRate() const { return m_tickRate; }

  bool isAvailable() const { return m_range.has_value(); }
  bool isPaused() const { return m_paused; }
  /// Playing on from the very end starts at the beginning.
  void setPaused(bool paused);
  /// So many ticks forward or back, then pauses.
  void step(int ticks);
  void toStart();
  double speed() const { return m_speed; }
  /// Seconds per second; kept between slowest and fastest.
  void setSpeed(double timesRealTime);
  std::span<const double> speeds() const;

  /// What the timer does: goes on by this much of a person's time. For tests as well.
  void advance(double seconds);

 signals:
  void changed();  ///< paused, speed, loop, or whether there is something to play
  void positionChanged(double time);
  /// Played up to the end of the range: paused there, unless who listens seeks or plays on.
  void reachedEnd();

 private:
  void move(double time);

  QTimer* m_timer;
  QElapsedTimer m_clock;
  std::optional<telemetry::TimeRange> m_range, m_loop;
  double m_position = 0.0;
  double m_speed = 1.0;
  double m_tickRate = 60.0;
  bool m_paused = true;
};

}  // namespace pitchboard::ui
