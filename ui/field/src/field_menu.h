// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The field's context menu, and what the menu bar offers of robots and ball. Window thread; it
// lives as long as it is open.

#include <QPointF>
#include <functional>

#include "field_scene.h"

class QMenu;

namespace pitchboard::ui {

class MatchController;

/// What the menu cannot do through the controller or the scene.
struct FieldMenuActions {
  std::function<void(RobotUid)> editPose;
  std::function<void(RobotUid)> showBlackboard;
  std::function<void()> editBall;
  std::function<void()> saveMoment;
};

/// Fills `menu` for the place where it was asked for.
void fillFieldMenu(QMenu* menu, FieldScene* scene, MatchController* controller,
                   const QPointF& metres, const FieldMenuActions& actions);

/// The same for the selected robots, and selecting them; new ones come to `metres`.
void fillRobotsMenu(QMenu* menu, FieldScene* scene, MatchController* controller,
                    const QPointF& metres, const FieldMenuActions& actions);

}  // namespace pitchboard::ui
