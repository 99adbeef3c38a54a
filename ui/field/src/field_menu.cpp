// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_menu.h"

#include <QMenu>
#include <QStringList>
#include <algorithm>
#include <numbers>

#include <ui/base/action_reason.h>
#include <ui/base/robot_text.h>
#include <ui/base/theme.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/referee_calls.h>
#include <ui/sources/robot_menus.h>

namespace pitchboard::ui {
namespace {

bool canEdit(const FieldScene* scene, const MatchController* controller) {
  return controller && scene->frame() && !scene->style().readOnly;
}

void addRobotsAt(QMenu* menu, const QString& words, MatchController* controller,
                 const QPointF& metres) {
  QMenu* add = menu->addMenu(themedIcon(QStringLiteral("list-add")), words);
  for (const TeamColorInfo& team : teamColors) {
    const Pose pose{fromScene(metres), team.facesLeft ? std::numbers::pi : 0.0};
    QAction* choice = add->addAction(
        capitalised(team.name), controller,
        [controller, color = team.color, pose] { controller->edits()->addRobot(color, pose); });
    enableUnless(*choice, controller->edits()->whyNoTeam(team.color));
  }
}

/// What can be done with these robots; `scene` shows them.
void addRobots(QMenu* menu, FieldScene* scene, MatchController* controller,
               const std::vector<RobotUid>& ids, const FieldMenuActions& actions) {
  const bool editable = canEdit(scene, controller);
  const RobotUid id = ids.front();
  if (editable) {
    addRobotMenus(menu, controller, scene->frame()->slotsOf(ids));
    menu->addSeparator();
    menu->addAction(QStringLiteral("Pose…"), menu, [actions, id] { actions.editPose(id); });
    menu->addAction(QStringLiteral("Blackboard…"), menu,
                    [actions, id] { actions.showBlackboard(id); });
  }
  QAction* follow = menu->addAction(QStringLiteral("Follow"));
  follow->setCheckable(true);
  follow->setChecked(scene->followed() == id);
  QObject::connect(follow, &QAction::toggled, scene, [scene, id](bool on) {
    scene->setFollowed(on ? std::optional(id) : std::nullopt);
  });
  QAction* trail = menu->addAction(QStringLiteral("Hide trail"));
  trail->setCheckable(true);
  trail->setChecked(!scene->isTrailShown(id));
  QObject::connect(trail, &QAction::toggled, scene, [scene, ids](bool hide) {
    for (const RobotUid robot : ids) scene->setTrailShown(robot, !hide);
  });
  if (!editable) return;
  menu->addSeparator();
  menu->addAction(themedIcon(QStringLiteral("edit-delete")),
                  ids.size() == 1 ? QStringLiteral("Remove robot")
                                  : QStringLiteral("Remove %1 robots").arg(ids.size()),
                  controller, [controller, robots = scene->frame()->slotsOf(ids)] {
                    controller->edits()->removeRobots(robots);
                  });
}

void addBall(QMenu* menu, MatchController* controller, const FieldMenuActions& actions) {
  menu->addAction(QStringLiteral("Ball position and speed…"), menu,
                  [actions] { actions.editBall(); });
  menu->addAction(QStringLiteral("Ball to the centre mark"), controller,
                  [controller] { controller->edits()->moveBall(Point{}); });
}

void addSelecting(QMenu* menu, FieldScene* scene) {
  QMenu* select = menu->addMenu(QStringLiteral("Select"));
  for (const link::RobotFrame& robot : scene->frame()->robots) {
    const auto& ids = scene->selection();
    QAction* action = select->addAction(robotName(robot));
    action->setCheckable(true);
    action->setChecked(std::find(ids.begin(), ids.end(), robot.uid) != ids.end());
    QObject::connect(action, &QAction::triggered, scene,
                     [scene, id = robot.uid] { scene->toggle(id); });
  }
  select->addSeparator();
  select->addAction(QStringLiteral("All"), scene, &FieldScene::selectAll);
  select->addAction(QStringLiteral("None"), scene, [scene] { scene->select({}); });
}

}  // namespace

void fillRobotsMenu(QMenu* menu, FieldScene* scene, MatchController* controller,
                    const QPointF& metres, const FieldMenuActions& actions) {
  if (!scene->frame()) return;
  if (!scene->frame()->robots.empty()) addSelecting(menu, scene);
  const std::vector<RobotUid> ids = scene->selection();
  if (!ids.empty()) {
    QStringList names;
    for (const RobotUid id : ids) {
      if (const auto* robot = scene->frame()->robot(id)) names << robotName(*robot);
    }
    menu->addSection(names.join(QStringLiteral(", ")));
    addRobots(menu, scene, controller, ids, actions);
  }
  if (!canEdit(scene, controller)) return;
  menu->addSeparator();
  addRobotsAt(menu, QStringLiteral("Add robot"), controller, metres);
  addBall(menu, controller, actions);
}

void fillFieldMenu(QMenu* menu, FieldScene* scene, MatchController* controller,
                   const QPointF& metres, const FieldMenuActions& actions) {
  const FieldHit hit = scene->hit(metres);
  const bool editable = canEdit(scene, controller);
  if (hit.kind == FieldHit::Kind::Robot || hit.kind == FieldHit::Kind::Handle) {
    const auto& selected = scene->selection();
    if (std::find(selected.begin(), selected.end(), hit.robot) == selected.end()) {
      scene->select({hit.robot});
    }
    std::vector<RobotUid> ids = scene->selection();
    // What concerns one concerns the one that was clicked.
    std::iter_swap(ids.begin(), std::find(ids.begin(), ids.end(), hit.robot));
    addRobots(menu, scene, controller, ids, actions);
  } else if (editable && hit.kind == FieldHit::Kind::Ball) {
    addBall(menu, controller, actions);
  } else if (editable) {
    addRobotsAt(menu, QStringLiteral("Add robot here"), controller, metres);
    menu->addAction(QStringLiteral("Place ball here"), controller,
                    [controller, metres] { controller->edits()->moveBall(fromScene(metres)); });
  }
  if (editable) {
    const bool ground = hit.kind == FieldHit::Kind::Nothing || hit.kind == FieldHit::Kind::Ball;
    if (ground) addRefereeGround(menu, controller, fromScene(metres));
    menu->addSeparator();
    menu->addAction(themedIcon(QStringLiteral("document-save")),
                    QStringLiteral("Save this moment as a scenario…"), menu,
                    [actions] { actions.saveMoment(); });
  }
}

}  // namespace pitchboard::ui
