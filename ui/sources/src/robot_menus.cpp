// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/robot_menus.h>

#include <QActionGroup>
#include <QFileDialog>
#include <QMenu>
#include <algorithm>

#include <robotlink/cognition/process_registry.h>
#include <robotlink/scenario/scenario.h>
#include <ui/base/robot_words.h>
#include <ui/sources/match_edits.h>

namespace pitchboard::ui {
namespace {

template <class Is>
bool allOf(const MatchController& controller, const std::vector<RobotId>& ids, Is is) {
  return std::all_of(ids.begin(), ids.end(), [&](RobotId id) {
    const link::ScenarioRobot* robot = controller.edits()->robot(id);
    return robot != nullptr && is(*robot);
  });
}

QAction* addChoice(QActionGroup* group, QMenu* menu, const QString& text, bool chosen) {
  QAction* action = menu->addAction(text);
  action->setCheckable(true);
  action->setActionGroup(group);
  action->setChecked(chosen);
  return action;
}

}  // namespace

void addBehaviourMenu(QMenu* menu, MatchController* controller, const std::vector<RobotId>& ids) {
  if (!allOf(*controller, ids, [](const auto&) { return true; })) return;
  QMenu* behaviour = menu->addMenu(QStringLiteral("Behaviour"));
  auto* group = new QActionGroup(behaviour);
  const auto offer = [&](std::string_view name, const QString& text) {
    const bool chosen =
        allOf(*controller, ids, [&](const link::ScenarioRobot& r) { return r.behaviour == name; });
    const QString key = QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size()));
    QObject::connect(addChoice(group, behaviour, text, chosen), &QAction::triggered, controller,
                     [controller, ids, key] { controller->edits()->setBehaviour(ids, key); });
  };
  for (const link::BehaviourInfo& known : link::behaviours())
    offer(known.name, capitalised(known.name));
  behaviour->addSeparator();
  offer(link::noBehaviour, QStringLiteral("None (your own process)"));
}

void addTeamMenu(QMenu* menu, MatchController* controller, const std::vector<RobotId>& ids) {
  if (!allOf(*controller, ids, [](const auto&) { return true; })) return;
  QMenu* team = menu->addMenu(QStringLiteral("Team"));
  auto* group = new QActionGroup(team);
  for (const TeamColorInfo& color : teamColors) {
    const bool chosen = allOf(*controller, ids, [&](const link::ScenarioRobot& r) {
      return r.identity.team == color.color;
    });
    QObject::connect(
        addChoice(group, team, capitalised(color.name), chosen), &QAction::triggered, controller,
        [controller, ids, to = color.color] { controller->edits()->setTeam(ids, to); });
  }
}

void addNumberMenu(QMenu* menu, MatchController* controller, RobotId id) {
  constexpr int mostShown = 11;
  const link::ScenarioRobot* robot = controller->edits()->robot(id);
  if (robot == nullptr) return;
  QMenu* numbers = menu->addMenu(QStringLiteral("Number"));
  auto* group = new QActionGroup(numbers);
  for (int number = 1; number <= mostShown; ++number) {
    QObject::connect(
        addChoice(group, numbers, QString::number(number), robot->identity.number == number),
        &QAction::triggered, controller,
        [controller, id, number] { controller->edits()->setNumber(id, number); });
  }
}

void addModelMenu(QMenu* menu, MatchController* controller, const std::vector<RobotId>& ids) {
  if (!allOf(*controller, ids, [](const auto&) { return true; })) return;
  QMenu* models = menu->addMenu(QStringLiteral("Model"));
  auto* group = new QActionGroup(models);
  for (const std::string& name : link::robotModels()) {
    const auto model = link::loadRobotModel(name);
    if (!model) continue;
    const bool chosen =
        allOf(*controller, ids, [&](const link::ScenarioRobot& r) { return r.model == *model; });
    const link::RobotModelText text = link::robotModelText(name);
    QAction* action = addChoice(group, models, QString::fromStdString(text.title), chosen);
    action->setToolTip(QString::fromStdString(text.description));
    QObject::connect(action, &QAction::triggered, controller, [controller, ids, model = *model] {
      controller->edits()->setModel(ids, model);
    });
  }
  models->setToolTipsVisible(true);
  models->addSeparator();
  models->addAction(QStringLiteral("From a file…"), controller, [controller, ids] {
    const QString path =
        QFileDialog::getOpenFileName(nullptr, QStringLiteral("Choose a robot model"), {},
                                     QStringLiteral("Robot models (*.json);;All files (*)"));
    if (path.isEmpty()) return;
    const auto model = link::loadRobotModel(path.toStdString());
    if (model) {
      controller->edits()->setModel(ids, *model);
    } else {
      emit controller->errorOccurred(QStringLiteral("The robot model was not taken: %1")
                                         .arg(QString::fromStdString(model.error().text())));
    }
  });
}

}  // namespace pitchboard::ui
