// SPDX-License-Identifier: GPL-3.0-or-later
#include "robots_button.h"

#include <QMenu>
#include <QMouseEvent>

#include <telemetry/series/group_order.h>
#include <ui/sources/compared_session.h>
#include <ui/sources/compared_sessions.h>
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

/// Stays the same when the robot is renamed, as isSameGroup() compares it.
QString lastingNameOf(const telemetry::GroupInfo& group) {
  return QString::fromStdString(group.id.empty() ? group.name : group.id);
}

}  // namespace

RobotsButton::RobotsButton(ShownMoment* shown, RobotSelection* selection,
                           const ComparedSessions* compared, QWidget* parent)
    : QToolButton(parent), m_shown(shown), m_selection(selection), m_compared(compared) {
  setObjectName(QStringLiteral("statisticsRobots"));
  setAccessibleName(QStringLiteral("Robots"));
  setToolTip(QStringLiteral("Robots and sessions whose variables are described"));
  setPopupMode(QToolButton::InstantPopup);
  setToolButtonStyle(Qt::ToolButtonTextOnly);
  auto* menu = new TickMenu(this);
  menu->setObjectName(QStringLiteral("statisticsRobotsMenu"));
  setMenu(menu);
  connect(menu, &QMenu::aboutToShow, this, &RobotsButton::fill);
  connect(selection, &RobotSelection::changed, this, [this] {
    if (m_followsSelection) emit changed();
  });
  connect(shown, &ShownMoment::sourceChanged, this, &RobotsButton::label);
  connect(compared, &ComparedSessions::changed, this, [this] {
    std::erase_if(m_leftOut, [this](quint64 id) {
      return m_compared->isEmpty() || (id != shownId && m_compared->find(id) == nullptr);
    });
    label();
  });
  choose(false, {});
}

std::vector<std::shared_ptr<const telemetry::GroupView>> RobotsButton::listed() const {
  std::vector<std::shared_ptr<const telemetry::GroupView>> views, sorted;
  const auto rows = m_shown->series();
  for (telemetry::GroupId group = 0; rows && group < rows->groups(); ++group) {
    views.push_back(rows->view(group));
  }
  for (const std::size_t index : telemetry::listedOrder(
           views, [](const auto& view) -> const telemetry::GroupInfo& { return view->info(); })) {
    sorted.push_back(views[index]);
  }
  return sorted;
}

std::vector<std::string> RobotsButton::robots() const {
  std::vector<std::string> names;
  if (!m_followsSelection && m_groups.isEmpty()) return names;
  for (const auto& view : listed()) {
    const telemetry::GroupInfo& group = view->info();
    const telemetry::RobotFacts& facts = telemetry::factsOf(group);
    const bool isChosen = m_followsSelection
                              ? facts.linkOf.empty() && m_selection->contains(facts.uid)
                              : m_groups.contains(lastingNameOf(group));
    if (isChosen) names.push_back(group.name);
  }
  return names;
}

void RobotsButton::fill() {
  menu()->clear();
  label();
  const auto add = [this](const QString& text, bool on, auto action) {
    QAction* made = menu()->addAction(text);
    made->setCheckable(true);
    made->setChecked(on);
    connect(made, &QAction::triggered, this, action);
    return made;
  };
  const bool isAll = !m_followsSelection && m_groups.isEmpty();
  add(QStringLiteral("All robots"), isAll, [this] { choose(false, {}); });
  add(QStringLiteral("Robots selected on the field"), m_followsSelection,
      [this] { choose(true, {}); });
  menu()->addSeparator();
  for (const auto& view : listed()) {
    const QString id = lastingNameOf(view->info());
    QAction* robot =
        add(QString::fromStdString(view->info().name), m_groups.contains(id), [this, id](bool on) {
          QStringList groups = m_groups;
          groups.removeAll(id);
          if (on) groups << id;
          choose(false, groups);
        });
    robot->setData(id);  // the menu stays open
  }
  if (m_compared->isEmpty()) return;
  menu()->addSection(QStringLiteral("Sessions"));
  addSession(QStringLiteral("The one shown"), shownId);
  for (const ComparedSession* session : m_compared->all()) {
    addSession(session->markedName(), session->id());
  }
}

void RobotsButton::addSession(const QString& text, quint64 id) {
  QAction* session = menu()->addAction(text);
  session->setCheckable(true);
  session->setChecked(!m_leftOut.contains(id));
  session->setData(id);  // the menu stays open
  connect(session, &QAction::triggered, this, [this, id](bool on) {
    if (on)
      m_leftOut.erase(id);
    else
      m_leftOut.insert(id);
    label();
    emit changed();
  });
}

bool RobotsButton::takes(const ComparedSession& session) const {
  return !m_leftOut.contains(session.id());
}

void RobotsButton::choose(bool followsSelection, const QStringList& groups) {
  m_followsSelection = followsSelection;
  m_groups = groups;
  const QList<QAction*> actions = menu()->actions();
  for (QAction* action : actions) {
    if (action->data().typeId() != QMetaType::QString) continue;
    action->setChecked(groups.contains(action->data().toString()));
  }
  if (actions.size() > 1) {
    actions[0]->setChecked(!followsSelection && groups.isEmpty());
    actions[1]->setChecked(followsSelection);
  }
  label();
  emit changed();
}

void RobotsButton::label() {
  constexpr qsizetype maxNamed = 3;
  QStringList names;
  for (const std::string& name : robots()) names << QString::fromStdString(name);
  QString text = m_followsSelection         ? QStringLiteral("Selected robots")
                 : names.isEmpty()          ? QStringLiteral("All robots")
                 : names.size() <= maxNamed ? names.join(QStringLiteral(", "))
                                            : QStringLiteral("%1 robots").arg(names.size());
  if (!m_leftOut.empty()) {
    const std::size_t all = 1 + m_compared->all().size();
    text += QStringLiteral(" · %1 of %2 sessions").arg(all - m_leftOut.size()).arg(all);
  }
  setText(text);
}

}  // namespace pitchboard::ui
