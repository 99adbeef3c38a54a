// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/models/robot_models.h>
#include <ui/sources/robot_menus.h>

#include <QActionGroup>
#include <QMenu>
#include <algorithm>
#include <array>
#include <span>

#include <robotlink/cognition/process_registry.h>
#include <robotlink/scenario/scenario.h>
#include <simcore/world/action_codes.h>
#include <ui/base/action_reason.h>
#include <ui/base/file_dialog.h>
#include <ui/base/robot_text.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/referee_calls.h>

namespace pitchboard::ui {
namespace {

template <class Is>
bool allOf(const MatchController& controller, const std::vector<RobotId>& ids, Is is) {
  return std::all_of(ids.begin(), ids.end(), [&](RobotId id) {
    const link::ScenarioRobot* robot = controller.edits()->robot(id);
    return robot != nullptr && is(*robot);
  });
}

/// Codes of the actions in the menu: what is ordered most often comes first, and what belongs
/// together stands together.
constexpr std::array<int, 7> kickOrders{4, 5, 21, 22, 12, 13, 0};
constexpr std::array<int, 10> walkOrders{1, 8, 17, 18, 6, 7, 2, 3, 9, 14};
constexpr std::array<int, 6> otherOrders{11, 10, 15, 16, 19, 20};
constexpr std::array<std::span<const int>, 3> orderGroups{kickOrders, walkOrders, otherOrders};
static_assert(kickOrders.size() + walkOrders.size() + otherOrders.size() == knownActions.size());

QAction* addChoice(QActionGroup* group, QMenu* menu, const QString& text, bool chosen) {
  QAction* action = menu->addAction(text);
  action->setCheckable(true);
  action->setActionGroup(group);
  action->setChecked(chosen);
  return action;
}

}  // namespace

void addRobotMenus(QMenu* menu, MatchController* controller, const std::vector<RobotId>& ids) {
  addOrderMenu(menu, controller, ids);
  addRefereeMenu(menu, controller, ids);
  addBehaviourMenu(menu, controller, ids);
  addRuntimeMenu(menu, controller, ids);
  addTeamMenu(menu, controller, ids);
  if (ids.size() == 1) addNumberMenu(menu, controller, ids.front());
  addModelMenu(menu, controller, ids);
}

void addOrderMenu(QMenu* menu, MatchController* controller, const std::vector<RobotId>& ids) {
  if (ids.empty()) return;
  QMenu* orders = menu->addMenu(QStringLiteral("Order"));
  const auto offer = [&](const ActionInfo& action) {
    orders->addAction(capitalised(action.label), controller, [controller, ids, action] {
      for (const RobotId id : ids) controller->edits()->commandAction(id, action.code);
    });
  };
  for (const auto& group : orderGroups) {
    for (const int code : group) offer(knownActions[static_cast<std::size_t>(code)]);
    orders->addSeparator();
  }
  for (const bool on : {true, false}) {
    orders->addAction(on ? QStringLiteral("Search for the ball") : QStringLiteral("Stop searching"),
                      controller, [controller, ids, on] {
                        for (const RobotId id : ids) controller->edits()->commandSearch(id, on);
                      });
  }
}

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
  offer(link::noBehaviour, QStringLiteral("None (team program)"));
}

void addRuntimeMenu(QMenu* menu, MatchController* controller, const std::vector<RobotId>& ids) {
  if (ids.empty() || !allOf(*controller, ids, [](const auto&) { return true; })) return;
  QMenu* runtime = menu->addMenu(QStringLiteral("Runtime"));
  auto* group = new QActionGroup(runtime);
  const auto choose = [controller](const std::vector<RobotId>& whom,
                                   const link::RuntimeChoice& choice) {
    for (const RobotId id : whom) controller->edits()->setRuntime(id, choice);
  };
  const auto isChosen = [controller, &ids](const link::RuntimeChoice& choice) {
    return allOf(*controller, ids,
                 [&](const link::ScenarioRobot& robot) { return robot.runtime == choice; });
  };
  const auto offer = [&](const QString& text, const link::RuntimeChoice& choice) {
    QObject::connect(addChoice(group, runtime, text, isChosen(choice)), &QAction::triggered,
                     controller, [choose, ids, choice] { choose(ids, choice); });
  };
  const auto askFile = [menu](const QString& title, const QString& filter) {
    return askToOpen(menu->parentWidget(), title, filter).toStdString();
  };
  offer(QStringLiteral("Default of its team and behaviour"), {});
  offer(QStringLiteral("Reference processes"), {std::string(link::referenceRuntime), {}, {}});
  offer(QStringLiteral("Team programs, started by me"), {std::string(link::ownRuntime), {}, {}});
  runtime->addSeparator();
  runtime->addAction(
      QStringLiteral("Run my program as decision…"), controller, [choose, ids, askFile] {
        const std::string file = askFile(QStringLiteral("Choose the decision program"), {});
        if (!file.empty()) choose(ids, {{}, {}, file});
      });
  runtime->addAction(QStringLiteral("Run a published code folder…"), controller, [=] {
    const std::string folder =
        askForFolder(menu->parentWidget(),
                     QStringLiteral("Choose the folder that contains AI, AI2, …"))
            .toStdString();
    if (!folder.empty()) choose(ids, {"published-tree", {{"folder", folder}}, {}});
  });
  runtime->addAction(QStringLiteral("Profile from a file…"), controller, [choose, ids, askFile] {
    const std::string file =
        askFile(QStringLiteral("Runtime profile"), QStringLiteral("Runtime profiles (*.json)"));
    if (!file.empty()) choose(ids, {file, {}, {}});
  });
  if (ids.size() != 1) return;
  runtime->addSeparator();
  runtime->addAction(QStringLiteral("My robot among reference robots"), controller, [=] {
    std::vector<RobotId> others;
    if (const FramePtr frame = controller->frame()) {
      for (const link::RobotFrame& robot : frame->robots) {
        if (robot.slot() != ids.front()) others.push_back(robot.slot());
      }
    }
    choose(others, {std::string(link::referenceRuntime), {}, {}});
    choose(ids, {std::string(link::ownRuntime), {}, {}});
  });
}

void addTeamMenu(QMenu* menu, MatchController* controller, const std::vector<RobotId>& ids) {
  if (!allOf(*controller, ids, [](const auto&) { return true; })) return;
  QMenu* team = menu->addMenu(QStringLiteral("Team"));
  auto* group = new QActionGroup(team);
  for (const TeamColorInfo& color : teamColors) {
    const bool chosen = allOf(*controller, ids, [&](const link::ScenarioRobot& r) {
      return r.identity.team == color.color;
    });
    QAction* choice = addChoice(group, team, capitalised(color.name), chosen);
    enableUnless(*choice, controller->edits()->whyNoTeam(color.color));
    QObject::connect(choice, &QAction::triggered, controller, [controller, ids, to = color.color] {
      controller->edits()->setTeam(ids, to);
    });
  }
  if (ids.empty()) return;
  const TeamColor its = controller->edits()->robot(ids.front())->identity.team;
  const auto isMate = [its](const link::ScenarioRobot& r) { return r.identity.team == its; };
  if (!allOf(*controller, ids, isMate)) return;
  team->addSeparator();
  QAction* advisor = team->addAction(QStringLiteral("Advisor"));
  advisor->setToolTip(QStringLiteral("The team's keeper learns where the opponents aim"));
  advisor->setCheckable(true);
  advisor->setChecked(controller->edits()->isAdvised(its));
  QObject::connect(advisor, &QAction::triggered, controller,
                   [controller, its](bool on) { controller->edits()->setAdvised(its, on); });
}

void addNumberMenu(QMenu* menu, MatchController* controller, RobotId id) {
  constexpr int maxShown = 11;
  const link::ScenarioRobot* robot = controller->edits()->robot(id);
  if (robot == nullptr) return;
  QMenu* numbers = menu->addMenu(QStringLiteral("Number"));
  auto* group = new QActionGroup(numbers);
  for (int number = 1; number <= maxShown; ++number) {
    sim::RobotIdentity wanted = robot->identity;
    wanted.number = number;
    QAction* choice =
        addChoice(group, numbers, QString::number(number), robot->identity.number == number);
    enableUnless(*choice, controller->edits()->isTaken(wanted)
                              ? QStringLiteral("Another robot of the team wears this number")
                              : QString());
    QObject::connect(choice, &QAction::triggered, controller,
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
  models->addSeparator();
  models->addAction(QStringLiteral("From a file…"), controller, [controller, ids] {
    const QString path = askToOpen(nullptr, QStringLiteral("Choose a robot model"),
                                   QStringLiteral("Robot models (*.json);;All files (*)"));
    if (path.isEmpty()) return;
    const auto model = link::loadRobotModel(path.toStdString());
    if (model) {
      controller->edits()->setModel(ids, *model);
    } else {
      emit controller->errorOccurred(QStringLiteral("Could not use the robot model: %1")
                                         .arg(QString::fromStdString(model.error().text())),
                                     Trouble::Refused);
    }
  });
}

}  // namespace pitchboard::ui
