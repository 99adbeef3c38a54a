// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A small popup with a robot's pose as numbers: metres and degrees. Changes are shown at once;
// Enter keeps them as one undoable command, Esc puts the robot back.

#include <QFrame>

#include <ui/match_controller.h>

class QDoubleSpinBox;

namespace pitchboard::ui {

class PoseEditor : public QFrame {
  Q_OBJECT
 public:
  PoseEditor(MatchController* controller, const sim::FieldSpec& field, const QString& robotName,
             RobotId id, const Pose& pose, QWidget* parent);

  Pose pose() const;

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

 private:
  void preview();

  MatchController* m_controller;
  RobotId m_id;
  Pose m_from;
  bool m_cancelled = false;
  QDoubleSpinBox* m_x;
  QDoubleSpinBox* m_y;
  QDoubleSpinBox* m_heading;
};

}  // namespace pitchboard::ui
