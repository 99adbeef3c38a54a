// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One search field for everything: actions of the menus, variables, robots, events. Enter does
// it: runs the action, plots the variable, selects the robot, shows the moment of the event. Made
// when it is asked for; closes after that. UI thread only.

#include <QDialog>
#include <functional>
#include <vector>

class QLineEdit;
class QListView;
class QStandardItemModel;

namespace pitchboard::ui {

class TextFilter;

/// Something that can be found.
struct PaletteEntry {
  QString text;  ///< "Simulation: Restart", "B1/VISION_BALL_DIST"
  QString kind;  ///< "Ctrl+R", "plot", "robot", "05:12.3"
  std::function<void()> run;
};

class CommandPalette : public QDialog {
  Q_OBJECT
 public:
  CommandPalette(std::vector<PaletteEntry> entries, QWidget* window);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void runCurrent();
  int best() const;

  std::vector<PaletteEntry> m_entries;
  QLineEdit* m_search;
  QListView* m_list;
  QStandardItemModel* m_model;
  TextFilter* m_filter;
};

}  // namespace pitchboard::ui
