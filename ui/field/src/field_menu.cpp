// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_menu.h"

#include <QMenu>
#include <algorithm>
#include <array>
#include <numbers>

#include <ui/base/robot_words.h>
#include <ui/base/theme.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/robot_menus.h>

namespace pitchboard::ui {
namespace {

void addPlaces(QMenu* menu, FieldScene* scene, MatchController* controller, const QPointF& metres) {
  QMenu* add =
      menu->addMenu(themedIcon(QStringLiteral("list-add")), QStringLiteral("Add robot here"));
  for (const TeamColorInfo& team : teamColors) {
    const Pose pose{fromScene(metres), team.facesLeft ? std::numbers::pi : 0.0};
    add->addAction(capitalised(team.name), controller, [controller, color = team.color, pose] {
      controller->edits()->addRobot(color, pose);
    });
  }
  menu->addAction(QStringLiteral("Place ball here"), controller, [controller, scene, metres] {
    controller->edits()->moveBall(scene->ball(), fromScene(metres));
  });
}

void addRobotActions(QMenu* menu, MatchController* controller, const std::vector<RobotId>& ids) {
  struct Entry {
    const char* text;
    int action;
  };
  constexpr std::array<Entry, 6> entries{{{"Kick left", 5},
                                          {"Kick right", 4},
                                          {"Pass left", 12},
                                          {"Pass right", 13},
                                          {"Walk forward", 1},
                                          {"Stop", 0}}};
  for (const Entry& entry : entries) {
    menu->addAction(QString::fromUtf8(entry.text), controller,
                    [controller, ids, action = entry.action] {
                      for (const RobotId id : ids) controller->edits()->commandAction(id, action);
                    });
  }
  addBehaviourMenu(menu, controller, ids);
  addRuntimeMenu(menu, controller, ids);
  addTeamMenu(menu, controller, ids);
}

}  // namespace

void fillFieldMenu(QMenu* menu, FieldScene* scene, MatchController* controller,
                   const QPointF& metres, const FieldMenuActions& actions) {
  const FieldHit hit = scene->hit(metres);
  const bool editable = controller && scene->frame() && !scene->style().readOnly;
  if (hit.kind == FieldHit::Kind::Robot || hit.kind == FieldHit::Kind::Handle) {
    const RobotId id = hit.robot;
    const auto& selected = scene->selection();
    if (std::find(selected.begin(), selected.end(), id) == selected.end()) scene->select({id});
    const std::vector<RobotId> ids = scene->selection();
    if (editable) {
      addRobotActions(menu, controller, ids);
      menu->addSeparator();
      menu->addAction(QStringLiteral("Pose…"), menu, [actions, id] { actions.editPose(id); });
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
      for (const RobotId robot : ids) scene->setTrailShown(robot, !hide);
    });
    if (editable) {
      menu->addSeparator();
      menu->addAction(themedIcon(QStringLiteral("edit-delete")),
                      ids.size() == 1 ? QStringLiteral("Remove robot")
                                      : QStringLiteral("Remove %1 robots").arg(ids.size()),
                      controller, [controller, ids] { controller->edits()->removeRobots(ids); });
    }
  } else if (editable && hit.kind == FieldHit::Kind::Ball) {
    menu->addAction(QStringLiteral("Ball position…"), menu, [actions] { actions.editBall(); });
    menu->addAction(QStringLiteral("Ball to the centre mark"), controller, [controller, scene] {
      controller->edits()->moveBall(scene->ball(), {0.0, 0.0});
    });
  } else if (editable) {
    addPlaces(menu, scene, controller, metres);
  }
  if (editable) {
    menu->addSeparator();
    menu->addAction(themedIcon(QStringLiteral("document-save")),
                    QStringLiteral("Save this moment as a scenario…"), menu,
                    [actions] { actions.saveMoment(); });
  }
}

}  // namespace pitchboard::ui
