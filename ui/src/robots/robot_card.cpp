// SPDX-License-Identifier: GPL-3.0-or-later
#include "robot_card.h"

#include <QHelpEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QToolTip>

#include <ui/theme.h>

namespace pitchboard::ui {

RobotCard::RobotCard(QWidget* parent) : QFrame(parent) {
  setFocusPolicy(Qt::TabFocus);
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
}

void RobotCard::setState(const CardState& state) {
  if (state == m_state) return;
  // Most updates change the last row only.
  CardState rest = state;
  rest.action = m_state.action;
  rest.detail = m_state.detail;
  const bool footOnly = rest == m_state;
  m_state = state;
  setAccessibleName(state.name);
  setAccessibleDescription(QStringLiteral("%1, %2").arg(state.action, state.tag));
  if (!footOnly) update();
  else if (!m_collapsed) update(rowRect(2));
}

void RobotCard::setSelected(bool selected) {
  if (selected == m_selected) return;
  m_selected = selected;
  update();
}

void RobotCard::setCollapsed(bool collapsed) {
  if (collapsed == m_collapsed) return;
  m_collapsed = collapsed;
  updateGeometry();
  update();
}

QSize RobotCard::sizeHint() const {
  return {scaled(this, 236), scaled(this, m_collapsed ? 30 : 74)};
}

QSize RobotCard::minimumSizeHint() const { return {scaled(this, 190), sizeHint().height()}; }

bool RobotCard::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    const auto* help = static_cast<QHelpEvent*>(event);
    QString tip;
    for (int lamp = 0; lamp < CardState::lampCount; ++lamp) {
      if (lampRect(lamp).contains(help->pos())) tip = lampTip(lamp);
    }
    if (!m_collapsed && rowRect(2).contains(help->pos())) {
      tip = tr("Action of the robot; age of the tick shown; distance walked");
    }
    if (tip.isEmpty()) QToolTip::hideText();
    else QToolTip::showText(help->globalPos(), tip, this);
    return true;
  }
  return QFrame::event(event);
}

QString RobotCard::lampTip(int lamp) const {
  const auto index = static_cast<std::size_t>(lamp);
  const QString process = QLatin1String(CardState::processes[index]);
  const Lamp& state = m_state.lamps[index];
  if (state.state == LampState::Working) return tr("%1: working").arg(process);
  if (state.state == LampState::Silent) {
    return tr("%1: silent for %2 s").arg(process).arg(state.seconds);
  }
  return tr("%1: not heard of since the match began").arg(process);
}

void RobotCard::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return QFrame::mousePressEvent(event);
  if (chevronRect().contains(event->pos())) setCollapsed(!m_collapsed);
  else emit clicked(event->modifiers());
}

void RobotCard::keyPressEvent(QKeyEvent* event) {
  switch (event->key()) {
    case Qt::Key_Space:
    case Qt::Key_Return:
    case Qt::Key_Enter: emit clicked(event->modifiers()); return;
    case Qt::Key_Left: setCollapsed(true); return;
    case Qt::Key_Right: setCollapsed(false); return;
    default: QFrame::keyPressEvent(event);
  }
}

void RobotCard::contextMenuEvent(QContextMenuEvent* event) {
  emit menuRequested(event->globalPos());
}

}  // namespace pitchboard::ui
