// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plays recorded time: a position that advances at a chosen speed, steps, and loops a range.
// Whoever shows the moment connects to positionChanged(). Seconds of the source. UI thread only.

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

  /// Sets the range that can be played; its ends may move during playback. Empty: nothing can.
  void setRange(std::optional<telemetry::TimeRange> range);
  std::optional<telemetry::TimeRange> range() const { return m_range; }
  /// Limits `time` to the range.
  void seek(double time);
  double position() const { return m_position; }
  /// Repeats this range; empty: plays to the end. Ignores a range without length.
  void setLoop(std::optional<telemetry::TimeRange> loop);
  std::optional<telemetry::TimeRange> loop() const { return m_loop; }
  /// Sets the ticks per second for step().
  void setTickRate(double perSecond);
  double tickRate() const { return m_tickRate; }

  bool isAvailable() const { return m_range.has_value(); }
  bool isPaused() const { return m_paused; }
  /// At the end of the range, playing starts from the beginning.
  void setPaused(bool paused);
  /// Moves by this many ticks and pauses.
  void step(int ticks);
  void toStart();
  double speed() const { return m_speed; }
  /// Limits the speed to the range from slowest to fastest.
  void setSpeed(double timesRealTime);
  std::span<const double> speeds() const;

  /// Advances by this much real time. Called by the timer and by tests.
  void advance(double seconds);

 signals:
  void changed();  ///< paused, speed, loop, or whether there is something to play
  void positionChanged(double time);
  /// The end of the range was reached. Playback pauses there unless a receiver seeks or plays.
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
