// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The window's menu bar. Every entry does something. UI thread only.

#include <QList>
#include <functional>
#include <vector>

#include "studio_parts.h"

class QAction;
class QDockWidget;
class QMenu;

namespace pitchboard::ui {

class Alarms;
class FieldOnly;
class MainWindow;
class ScenarioChooser;
class ScenarioFiles;
class SessionFiles;
class StudioStatusBar;
class UndoHistory;

/// What the menus' entries act on; everything outlives them.
struct MenuContext {
  StudioParts parts;
  UndoHistory* undo;
  ScenarioFiles* files;
  SessionFiles* sessions;
  ScenarioChooser* scenarios;  ///< knows the recent ones
  QList<QAction*> transport;   ///< restart, play/pause, step
  QList<QAction*> speedSteps;  ///< slower, faster
  std::function<void()> showShortcuts;
  StudioStatusBar* status;
  std::vector<QDockWidget*> docks;
  FieldOnly* fieldOnly;
  Alarms* alarms;
};

/// Makes the menus, once.
class StudioMenus {
 public:
  StudioMenus(MenuContext context, MainWindow& window);
  void make();

 private:
  void makeFile();
  void makeEdit();
  void makeView();
  void makeThemes(QMenu* menu);
  void makeRobots();
  void makeSimulation();
  void makeLive();
  void makeTimeline();
  void makePlots();
  void makeHelp();
  /// Greyed while another source than the simulation is shown.
  void onlyInTheMatch(QAction* action);

  MenuContext m_context;
  const StudioParts& m_parts;
  MainWindow& m_window;
};

}  // namespace pitchboard::ui
