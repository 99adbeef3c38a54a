// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The menu bar. Window thread; its actions belong to the main window, whose member it is.

class QAction;
class QMenu;

namespace pitchboard::ui {

class MainWindow;

/// Fills the window's menu bar. Every entry does something.
class StudioMenus {
 public:
  explicit StudioMenus(MainWindow& window) : m_window(window) {}
  void make();

 private:
  void makeFile();
  void makeEdit();
  void makeView();
  void makeThemes(QMenu* menu);
  void makeSimulation();
  void makeTimeline();
  void makePlots();
  void makeHelp();
  /// Greyed while another source than the simulation is shown.
  void onlyWhenSimulating(QAction* action);

  MainWindow& m_window;
};

}  // namespace pitchboard::ui
