// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Draws attention to chosen events at a match: the window asks for attention, the field gets a red
// frame for a moment, and, if wanted, there is a sound. Which ones is kept in the settings. UI
// thread only.

#include <QObject>
#include <functional>
#include <set>
#include <utility>
#include <vector>

#include <robotlink/frame/match_event.h>

class QMenu;
class QSettings;
class QWidget;

namespace pitchboard::ui {

class AlarmFrame;
class ShownMoment;

class Alarms : public QObject {
  Q_OBJECT
 public:
  /// Listens to every source that the switch has by now. `field`: gets the frame.
  Alarms(ShownMoment* sources, QWidget* field, QSettings* settings, QObject* parent);
  /// A tick for each kind of event that can be an alarm, and one for the sound.
  void fill(QMenu* menu);
  /// Raises the alarm for a rule of severity error, unless it is switched off.
  void raiseForRule(const QString& sentence);
  /// The red edge is seen; what it is about is said a little longer.
  bool isRaised() const;
  /// What makes the sound; at first that of the desktop.
  void setBell(std::function<void()> ring) { m_ring = std::move(ring); }

 private:
  void take(const std::vector<link::MatchEvent>& events);
  void raise(const QString& sentence);
  void keep();

  AlarmFrame* m_frame;  // over the field
  QSettings* m_settings;
  std::set<link::MatchEventKind> m_chosen;
  bool m_rules = true, m_sound = false;
  std::function<void()> m_ring;
};

}  // namespace pitchboard::ui
