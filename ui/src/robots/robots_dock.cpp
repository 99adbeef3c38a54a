// SPDX-License-Identifier: GPL-3.0-or-later
#include "robots_dock.h"

#include <QActionGroup>
#include <QLabel>
#include <QMenu>
#include <QTimer>
#include <QVBoxLayout>
#include <set>

#include <ui/field_view.h>
#include <ui/match_controller.h>
#include <ui/theme.h>

#include "blackboard_window.h"
#include "robot_card.h"
#include "shell/robot_menus.h"
#include "shell/robot_selection.h"
#include "shell/source_switch.h"

namespace pitchboard::ui {

RobotsDock::RobotsDock(const StudioContext& context, QWidget* parent)
    : QScrollArea(parent), m_context(context) {
  constexpr int refreshMilliseconds = 100;
  setFrameShape(QFrame::NoFrame);
  setWidgetResizable(true);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  auto* list = new QWidget(this);
  list->setBackgroundRole(QPalette::Base);
  list->setAutoFillBackground(true);
  viewport()->setBackgroundRole(QPalette::Base);
  m_column = new QVBoxLayout(list);
  const int gap = scaled(this, 4);
  m_column->setContentsMargins(gap, gap, gap, gap);
  m_column->setSpacing(gap);
  m_empty = new QLabel(list);
  m_empty->setObjectName(QStringLiteral("noRobots"));
  m_empty->setFont(themeFont(TypeRole::Secondary));
  m_empty->setForegroundRole(QPalette::PlaceholderText);
  m_empty->setContentsMargins(scaled(this, 8), scaled(this, 8), scaled(this, 8), 0);
  m_empty->setWordWrap(true);
  m_column->addWidget(m_empty);
  m_column->addStretch(1);
  setWidget(list);

  m_clock.start();
  auto* timer = new QTimer(this);
  connect(timer, &QTimer::timeout, this, [this] {
    if (isVisible()) refresh();
  });
  timer->start(refreshMilliseconds);
  connect(context.source, &FrameSource::restarted, this, [this] {
    m_tracker.reset();
    refresh();
  });
  connect(context.selection, &RobotSelection::changed, this, &RobotsDock::showSelection);
}

QSize RobotsDock::sizeHint() const { return {scaled(this, 256), scaled(this, 300)}; }

void RobotsDock::refresh() {
  const FramePtr frame = m_context.source->frame();
  if (!frame) {
    makeCards(0);
    return;
  }
  const std::vector<CardState> states = m_tracker.update(*frame, m_clock.elapsed());
  // A card stands for the robot at its place: when one leaves, those after it move up.
  std::set<RobotId> collapsed;
  for (const RobotCard* card : m_cards) {
    if (card->isCollapsed()) collapsed.insert(card->state().id);
  }
  makeCards(states.size());
  for (std::size_t i = 0; i < states.size(); ++i) {
    RobotCard* card = m_cards[static_cast<qsizetype>(i)];
    card->setState(states[i]);
    card->setCollapsed(collapsed.count(states[i].id) != 0);
  }
  showSelection();
}

void RobotsDock::makeCards(std::size_t count) {
  m_empty->setVisible(count == 0);
  if (count == 0) {
    m_empty->setText(m_context.source->emptyText());
  }
  while (m_cards.size() > static_cast<qsizetype>(count)) delete m_cards.takeLast();
  while (m_cards.size() < static_cast<qsizetype>(count)) {
    auto* card = new RobotCard(widget());
    connect(card, &RobotCard::clicked, this, [this, card](Qt::KeyboardModifiers modifiers) {
      if (modifiers & Qt::ControlModifier) m_context.selection->toggle(card->state().id);
      else m_context.selection->set({card->state().id});
    });
    connect(card, &RobotCard::menuRequested, this,
            [this, card](const QPoint& at) { showMenu(card, at); });
    m_column->insertWidget(static_cast<int>(m_cards.size()), card);
    m_cards.append(card);
  }
}

void RobotsDock::showSelection() {
  for (RobotCard* card : m_cards) card->setSelected(m_context.selection->contains(card->state().id));
}

void RobotsDock::setAllCollapsed(bool collapsed) {
  for (RobotCard* card : m_cards) card->setCollapsed(collapsed);
}

void RobotsDock::showMenu(RobotCard* card, const QPoint& at) {
  const RobotId id = card->state().id;
  MatchController* controller = m_context.controller;
  if (controller->robot(id) == nullptr) return;
  QMenu menu(this);
  addBehaviourMenu(&menu, controller, {id});
  addTeamMenu(&menu, controller, {id});
  QAction* follow = menu.addAction(tr("Follow"));
  follow->setCheckable(true);
  follow->setChecked(m_context.field->followed() == id);
  connect(follow, &QAction::toggled, m_context.field, [field = m_context.field, id](bool on) {
    field->follow(on ? std::optional(id) : std::nullopt);
  });
  menu.addAction(tr("Blackboard…"), this, [this, id] {
    (new BlackboardWindow(m_context.controller, id, window()))->show();
  });
  menu.addSeparator();
  menu.addAction(tr("Collapse all"), this, [this] { setAllCollapsed(true); });
  menu.addAction(tr("Expand all"), this, [this] { setAllCollapsed(false); });
  menu.addSeparator();
  menu.addAction(themedIcon(QStringLiteral("edit-delete")), tr("Remove %1").arg(card->state().name),
                 controller, [controller, id] { controller->removeRobots({id}); });
  menu.exec(at);
}

QWidget* makeRobotsDock(const StudioContext& context, QWidget* parent) {
  return new RobotsDock(context, parent);
}

}  // namespace pitchboard::ui
