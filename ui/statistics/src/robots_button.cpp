// SPDX-License-Identifier: GPL-3.0-or-later
#include "robots_button.h"

#include <QMenu>
#include <QMouseEvent>

#include <telemetry/series/group_order.h>
#include <ui/sources/robot_selection.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {
namespace {

/// Stays open while robots are ticked.
class TickMenu : public QMenu {
 public:
  using QMenu::QMenu;

 protected:
  void mouseReleaseEvent(QMouseEvent* event) override {
    QAction* action = actionAt(event->position().toPoint());
    if (action != nullptr && action->isEnabled() && action->data().isValid()) {
      action->trigger();
    } else {
      QMenu::mouseReleaseEvent(event);
    }
  }
};

}  // namespace

RobotsButton::RobotsButton(ShownMoment* shown, RobotSelection* selection, QWidget* parent)
    : QToolButton(parent), m_shown(shown), m_selection(selection) {
  setObjectName(QStringLiteral("statisticsRobots"));
  setAccessibleName(QStringLiteral("Robots"));
  setToolTip(QStringLiteral("Robots whose variables are described"));
  setPopupMode(QToolButton::InstantPopup);
  setToolButtonStyle(Qt::ToolButtonTextOnly);
  auto* menu = new TickMenu(this);
  menu->setObjectName(QStringLiteral("statisticsRobotsMenu"));
  setMenu(menu);
  connect(menu, &QMenu::aboutToShow, this, &RobotsButton::fill);
  connect(selection, &RobotSelection::changed, this, [this] {
    if (m_followsSelection) emit changed();
  });
  choose(false, {});
}

std::vector<std::string> RobotsButton::robots() const {
  std::vector<std::string> names;
  if (!m_followsSelection) {
    for (const QString& name : m_names) names.push_back(name.toStdString());
    return names;
  }
  const auto rows = m_shown->series();
  for (telemetry::GroupId group = 0; rows && group < rows->groups(); ++group) {
    const auto view = rows->view(group);
    const telemetry::RobotFacts& facts = telemetry::factsOf(view->info());
    if (facts.linkOf.empty() && m_selection->contains(facts.uid))
      names.push_back(view->info().name);
  }
  return names;
}

void RobotsButton::fill() {
  menu()->clear();
  const auto add = [this](const QString& text, bool on, auto action) {
    QAction* made = menu()->addAction(text);
    made->setCheckable(true);
    made->setChecked(on);
    connect(made, &QAction::triggered, this, action);
    return made;
  };
  const bool isAll = !m_followsSelection && m_names.isEmpty();
  add(QStringLiteral("All robots"), isAll, [this] { choose(false, {}); });
  add(QStringLiteral("Robots selected on the field"), m_followsSelection,
      [this] { choose(true, {}); });
  menu()->addSeparator();
  std::vector<std::shared_ptr<const telemetry::GroupView>> views;
  const auto rows = m_shown->series();
  for (telemetry::GroupId group = 0; rows && group < rows->groups(); ++group) {
    views.push_back(rows->view(group));
  }
  const auto order = telemetry::listedOrder(
      views, [](const auto& view) -> const telemetry::GroupInfo& { return view->info(); });
  for (const std::size_t index : order) {
    const QString name = QString::fromStdString(views[index]->info().name);
    QAction* robot = add(name, m_names.contains(name), [this, name](bool on) {
      QStringList names = m_names;
      names.removeAll(name);
      if (on) names << name;
      choose(false, names);
    });
    robot->setData(name);  // the menu stays open
  }
}

void RobotsButton::choose(bool followsSelection, const QStringList& names) {
  m_followsSelection = followsSelection;
  m_names = names;
  const QList<QAction*> actions = menu()->actions();
  for (QAction* action : actions) {
    if (action->data().isValid()) action->setChecked(names.contains(action->data().toString()));
  }
  if (actions.size() > 1) {
    actions[0]->setChecked(!followsSelection && names.isEmpty());
    actions[1]->setChecked(followsSelection);
  }
  constexpr qsizetype mostNamed = 3;
  setText(followsSelection            ? QStringLiteral("Selected robots")
          : names.isEmpty()           ? QStringLiteral("All robots")
          : names.size() <= mostNamed ? names.join(QStringLiteral(", "))
                                      : QStringLiteral("%1 robots").arg(names.size()));
  emit changed();
}

}  // namespace pitchboard::ui
