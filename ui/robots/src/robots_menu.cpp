// SPDX-License-Identifier: GPL-3.0-or-later
// What the cards' menu offers, and which parts of a card are shown.
#include <QMenu>
#include <QSettings>
#include <algorithm>

#include <telemetry/formats/meanings.h>
#include <ui/base/action_reason.h>
#include <ui/base/robot_text.h>
#include <ui/base/theme.h>
#include <ui/robots/robots_dock.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/robot_menus.h>
#include <ui/sources/robot_selection.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {
namespace {

struct Part {
  const char* key;  // in the settings: never change it
  const char* text;
  bool CardParts::*shown;
};
constexpr Part cardParts[] = {{"battery", "Battery", &CardParts::battery},
                              {"processes", "Processes", &CardParts::processes},
                              {"action", "Action", &CardParts::action},
                              {"health", "Age, rate, loss, errors", &CardParts::health}};

const QString hiddenKey = QStringLiteral("cards/hidden");
const QString valuesKey = QStringLiteral("cards/values");

}  // namespace

void RobotsDock::loadParts() {
  if (m_context.settings == nullptr) return;
  const QStringList hidden = m_context.settings->value(hiddenKey).toStringList();
  for (const Part& part : cardParts)
    m_parts.*part.shown = !hidden.contains(QLatin1String(part.key));
  for (const QString& name : m_context.settings->value(valuesKey).toStringList()) {
    m_parts.values << QString::fromStdString(
        std::string(telemetry::presentName(name.toStdString())));
  }
}

void RobotsDock::setParts(const CardParts& parts) {
  m_parts = parts;
  for (const auto& [id, card] : m_cards) card->setParts(parts);
  if (m_context.settings == nullptr) return;
  QStringList hidden;
  for (const Part& part : cardParts) {
    if (!(parts.*part.shown)) hidden << QLatin1String(part.key);
  }
  m_context.settings->setValue(hiddenKey, hidden);
  m_context.settings->setValue(valuesKey, parts.values);
}

void RobotsDock::addMatchActions(QMenu& menu, RobotCard* card) {
  const RobotUid id = card->state().id;
  MatchController* controller = m_context.controller;
  const FramePtr frame = m_context.shown->frame();
  const auto robots = frame ? frame->slotsOf({id}) : std::vector<RobotId>();
  if (robots.empty() || controller->edits()->robot(robots.front()) == nullptr) return;
  addRobotMenus(&menu, controller, robots);
  menu.addSeparator();
  menu.addAction(QStringLiteral("Pose…"), this,
                 [this, id] { emit m_context.selection->poseRequested(id); });
  menu.addAction(QStringLiteral("Blackboard…"), this,
                 [this, id] { emit m_context.selection->blackboardRequested(id); });
  menu.addAction(themedIcon(QStringLiteral("edit-delete")),
                 QStringLiteral("Remove %1").arg(card->state().name), controller,
                 [controller, robots] { controller->edits()->removeRobots(robots); });
  menu.addSeparator();
}

void RobotsDock::addCardActions(QMenu& menu) {
  const QList<RobotCard*> listed = cards();
  QMenu* own = menu.addMenu(QStringLiteral("Cards"));
  if (!listed.isEmpty()) addPartActions(*own, listed.front());
  addListActions(*own);
  for (const RobotUid id : m_context.selection->ids()) {
    const auto card = m_cards.find(id);
    if (card == m_cards.end()) continue;
    if (m_context.live != nullptr && m_context.shown->source() == m_context.live) {
      addForgetting(menu, card->second);
    }
    if (m_floating.count(id) != 0) continue;
    own->addAction(QStringLiteral("Open %1 in a window").arg(card->second->state().name), this,
                   [this, id] { floatCard(id); });
  }
}

void RobotsDock::addForgetting(QMenu& menu, RobotCard* card) {
  const RobotUid id = card->state().id;
  QAction* forget = menu.addAction(themedIcon(QStringLiteral("edit-delete")),
                                   QStringLiteral("Forget %1").arg(card->state().name),
                                   m_context.live, [this, id] { m_context.live->forget(id); });
  forget->setObjectName(QStringLiteral("forgetRobot"));
  forget->setToolTip(QStringLiteral("Removes its card until it sends again; its curves stay"));
}

void RobotsDock::addListActions(QMenu& menu) {
  menu.addAction(QStringLiteral("Collapse all"), this, [this] { setAllCollapsed(true); });
  menu.addAction(QStringLiteral("Expand all"), this, [this] { setAllCollapsed(false); });
  menu.addAction(QStringLiteral("Order by number"), this, [this] {
    std::ranges::sort(m_order, {}, [this](RobotUid robot) { return m_places.at(robot); });
    arrange();
  });
}

void RobotsDock::addPartActions(QMenu& menu, RobotCard* card) {
  QMenu* show = menu.addMenu(QStringLiteral("Show on cards"));
  for (const Part& part : cardParts) {
    QAction* action = show->addAction(QString::fromUtf8(part.text));
    action->setCheckable(true);
    action->setChecked(m_parts.*part.shown);
    connect(action, &QAction::toggled, this, [this, shown = part.shown](bool on) {
      CardParts changed = m_parts;
      changed.*shown = on;
      setParts(changed);
    });
  }
  show->addSeparator();
  QStringList names;
  for (const CardValue& value : card->state().values) names << value.name;
  for (const QString& name : m_parts.values) {
    if (!names.contains(name)) names << name;
  }
  for (const QString& name : names) {
    QAction* action = show->addAction(name);
    action->setCheckable(true);
    action->setChecked(m_parts.values.contains(name));
    connect(action, &QAction::toggled, this, [this, name](bool on) {
      CardParts changed = m_parts;
      if (on)
        changed.values << name;
      else
        changed.values.removeAll(name);
      setParts(changed);
    });
  }
}

void RobotsDock::showMenu(RobotCard* card, const QPoint& at) {
  const RobotUid id = card->state().id;
  const auto& selected = m_context.selection->ids();
  if (std::ranges::find(selected, id) == selected.end()) m_context.selection->set({id});
  QMenu menu(this);
  if (m_context.shown->kind().canBeEdited) {
    addMatchActions(menu, card);
    if (m_context.controller->edits()->isLocked()) {
      for (QAction* change : menu.actions()) enableUnless(*change, MatchEdits::lockedText());
    }
  }
  if (m_context.live != nullptr && m_context.shown->source() == m_context.live) {
    addForgetting(menu, card);
    menu.addSeparator();
  }
  QAction* follow = menu.addAction(QStringLiteral("Follow"));
  follow->setCheckable(true);
  follow->setChecked(m_context.selection->followed() == id);
  connect(follow, &QAction::toggled, m_context.selection,
          [selection = m_context.selection, id](bool on) {
            selection->follow(on ? std::optional(id) : std::nullopt);
          });
  if (m_floating.count(id) == 0) {
    menu.addAction(QStringLiteral("Open in a window"), this, [this, id] { floatCard(id); });
  } else {
    menu.addAction(QStringLiteral("Back to the list"), this, [this, id] { unfloat(id); });
  }
  addPartActions(menu, card);
  menu.addSeparator();
  addListActions(menu);
  menu.exec(at);
}

}  // namespace pitchboard::ui
