// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A small popup with the place of a robot, or place and speed of the ball, as numbers: metres,
// degrees, metres per second. What is typed is shown at once; Enter makes it one edit, Esc gives it
// up.

#include <QFrame>
#include <functional>
#include <optional>

#include <base/geometry.h>
#include <simcore/world/field.h>

namespace pitchboard::ui {

class NumberBox;

/// What is edited, and how its changes reach the world.
struct PoseEdit {
  QString title;
  Pose from;
  bool isBall = false;                                   ///< the heading is that of its motion
  double speed = 0.0;                                    ///< m/s, of the ball
  std::function<void(const std::optional<Pose>&)> show;  ///< while typing; empty: no longer
  std::function<void(const Pose&, double speed)> keep;   ///< at most once, and only for a change
};

class PoseEditor : public QFrame {
  Q_OBJECT
 public:
  PoseEditor(PoseEdit edit, const sim::FieldSpec& field, QWidget* parent);

  Pose pose() const;

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

 private:
  bool isChanged() const;

  PoseEdit m_edit;
  bool m_cancelled = false;
  NumberBox* m_x;
  NumberBox* m_y;
  NumberBox* m_heading;
  NumberBox* m_speed = nullptr;  // of the ball
};

}  // namespace pitchboard::ui
