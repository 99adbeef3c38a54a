// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Shows the simulated and the live match together: while it is on, it provides the frames of the
// one that is not shown. UI thread only.

#include <QObject>

#include <ui/sources/frame_source.h>

namespace pitchboard::ui {

class LiveController;
class MatchController;
class ShownMoment;

class LiveOverlay : public QObject {
  Q_OBJECT
 public:
  LiveOverlay(MatchController* controller, LiveController* live, ShownMoment* shown,
              QObject* parent);
  bool isOn() const { return m_on; }
  /// Turning it on also starts Live.
  void setOn(bool on);
  /// Returns the newest frame of the other source; null while the overlay is off.
  FramePtr other() const;

 signals:
  void switched(bool on);
  /// other() may have changed.
  void otherReceived(const pitchboard::ui::FramePtr& frame);

 private:
  void show();

  MatchController* m_controller;
  LiveController* m_live;
  ShownMoment* m_shown;
  bool m_on = false;
};

}  // namespace pitchboard::ui
