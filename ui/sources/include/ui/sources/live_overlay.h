// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The simulated and the live match side by side: while it is on, it also tells where the other of
// the two sees each robot. UI thread only.

#include <QObject>

#include <ui/sources/frame_source.h>

namespace pitchboard::ui {

class LiveController;
class MatchController;
class SourceSwitch;

class LiveOverlay : public QObject {
  Q_OBJECT
 public:
  LiveOverlay(MatchController* controller, LiveController* live, SourceSwitch* shown,
              QObject* parent);
  bool isOn() const { return m_on; }
  /// Live begins to listen.
  void setOn(bool on);
  /// The other source's newest frame; null while it is off or there is no other.
  FramePtr other() const;

 signals:
  void switched(bool on);
  /// other(), whenever that may be another one.
  void otherReceived(const pitchboard::ui::FramePtr& frame);

 private:
  void show();

  MatchController* m_controller;
  LiveController* m_live;
  SourceSwitch* m_shown;
  bool m_on = false;
};

}  // namespace pitchboard::ui
