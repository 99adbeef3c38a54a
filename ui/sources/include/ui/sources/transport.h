// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the buttons play, pause, step and speed act on: a simulated match, or what is being played
// back. UI thread only.

#include <QObject>
#include <span>

namespace pitchboard::ui {

class Transport : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;

  virtual bool isAvailable() const = 0;
  virtual bool isPaused() const = 0;
  virtual void setPaused(bool paused) = 0;
  /// One tick forward or back, then pauses. Back only in what is played back.
  virtual void step(int ticks) = 0;
  virtual void toStart() = 0;
  /// Seconds per second; link::MatchRunner::unlimitedSpeed: as fast as possible.
  virtual double speed() const = 0;
  virtual void setSpeed(double timesRealTime) = 0;
  virtual std::span<const double> speeds() const = 0;

 signals:
  void changed();
};

}  // namespace pitchboard::ui
