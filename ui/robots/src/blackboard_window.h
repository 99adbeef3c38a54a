// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A robot's blackboard as a window, opened from its card. Window thread; it owns itself.

#include <QDialog>

#include <base/ids.h>

class QLabel;
class QTableWidget;

namespace pitchboard::ui {

class MatchController;

/// Where a robot's blackboard is, how another program reaches it, and its main values as they
/// change. Not modal; deletes itself when closed, closes when the robot leaves.
class BlackboardWindow : public QDialog {
  Q_OBJECT
 public:
  BlackboardWindow(MatchController* controller, RobotId id, QWidget* parent);

 private:
  void refresh();
  void setRow(int row, const QString& name, const QString& value, const QString& unit);

  MatchController* m_controller;
  RobotId m_id;
  QLabel* m_where;
  QTableWidget* m_table;
};

}  // namespace pitchboard::ui
