// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The tool bar: mode, scenario, transport, speed, scoreboard.

#include <QToolBar>

#include "dock_list.h"

class QComboBox;
class QSettings;

namespace pitchboard::ui {

class ScenarioChooser;
class Scoreboard;

class TransportBar : public QToolBar {
  Q_OBJECT
 public:
  TransportBar(const StudioContext& context, QSettings* settings, QWidget* parent);
  ScenarioChooser* scenarios() const { return m_scenarios; }
  /// Restart, play/pause, step: for the menu too.
  QList<QAction*> transportActions() const { return {m_restart, m_play, m_step}; }

 private:
  void addModes();
  void addTransport();
  void showTransport();

  StudioContext m_context;
  ScenarioChooser* m_scenarios;
  Scoreboard* m_scoreboard;
  QComboBox* m_speed;
  QAction* m_restart;
  QAction* m_play;
  QAction* m_step;
};

}  // namespace pitchboard::ui
