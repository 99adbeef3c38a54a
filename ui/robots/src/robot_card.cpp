// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/robots/robot_card.h>

#include <QApplication>
#include <QHelpEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QToolTip>

#include <ui/base/robot_text.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {

RobotCard::RobotCard(QWidget* parent) : QFrame(parent) {
  setFocusPolicy(Qt::TabFocus);
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
}

void RobotCard::setState(const CardState& state) {
  if (state == m_state) return;
  // Most updates change the last row, and values that are not shown.
  CardState rest = state;
  rest.action = m_state.action;
  rest.detail = m_state.detail;
  rest.detailTip = m_state.detailTip;
  if (m_parts.values.isEmpty()) rest.values = m_state.values;
  const bool footOnly = rest == m_state;
  const bool footSame = state.action == m_state.action && state.detail == m_state.detail;
  const bool taller = state.tag.isEmpty() != m_state.tag.isEmpty() && !m_parts.processes;
  m_state = state;
  if (taller) updateGeometry();
  setAccessibleName(state.name);
  QStringList texts{state.teamName, state.subtitle, state.action, state.tag};
  texts.removeAll(QString());
  setAccessibleDescription(texts.join(QStringLiteral(", ")));
  if (!footOnly)
    update();
  else if (!m_collapsed && !footSame)
    update(rowRect(2));
}

void RobotCard::setParts(const CardParts& parts) {
  if (parts == m_parts) return;
  m_parts = parts;
  updateGeometry();
  update();
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
  int height = 30;
  if (!m_collapsed) {
    const int rows = 3 + static_cast<int>(m_parts.values.size());
    height = 10;
    for (int row = 0; row < rows; ++row) {
      if (const int high = rowHeight(row); high > 0) height += high;
    }
  }
  return {scaled(this, 236), scaled(this, height)};
}

QSize RobotCard::minimumSizeHint() const {
  return {scaled(this, 190), sizeHint().height()};
}

bool RobotCard::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    const auto* help = static_cast<QHelpEvent*>(event);
    const bool alarm = showsTag();
    QString tip;
    if (alarm && tagRect().contains(help->pos())) {
      tip = m_state.tagTip.isEmpty() ? m_state.tag : m_state.tagTip;
    } else if (!m_collapsed && rowRect(2).contains(help->pos())) {
      tip = QStringLiteral("%1\n%2").arg(m_state.action, m_state.detailTip);
    } else if (rowRect(0).contains(help->pos())) {
      tip = headTip();
    }
    for (int lamp = 0; lamp < CardState::lampCount && m_parts.processes; ++lamp) {
      if (m_collapsed && alarm) break;  // the tag stands in their place
      if (lampRect(lamp).contains(help->pos())) tip = lampTip(lamp);
    }
    if (tip.isEmpty())
      QToolTip::hideText();
    else
      QToolTip::showText(help->globalPos(), tip, this);
    return true;
  }
  return QFrame::event(event);
}

QString RobotCard::headTip() const {
  QStringList lines{m_state.name};
  if (!m_state.teamName.isEmpty()) lines.first() += QStringLiteral(" of %1").arg(m_state.teamName);
  if (!m_state.address.isEmpty()) lines << QStringLiteral("Sends from %1").arg(m_state.address);
  if (!m_state.subtitle.isEmpty()) lines << m_state.subtitle;
  if (!m_state.runtime.isEmpty()) lines << QStringLiteral("Runs: %1").arg(m_state.runtime);
  if (m_state.battery) {
    lines << QStringLiteral("Battery %1 %, %2 V")
                 .arg(qRound(m_state.battery->fraction * 100))
                 .arg(numberText(m_state.battery->volts, 1));
  }
  if (m_collapsed) lines << m_state.action;
  return lines.join(QLatin1Char('\n'));
}

QString RobotCard::lampTip(int lamp) const {
  const auto index = static_cast<std::size_t>(lamp);
  const QString process = m_state.process(index);
  const Lamp& state = m_state.lamps[index];
  if (state.state == LampState::Working) return QStringLiteral("%1: working").arg(process);
  if (state.stopped) return QStringLiteral("%1: stopped").arg(process);
  if (state.state == LampState::NotResponding) {
    return QStringLiteral("%1: not responding for %2").arg(process, durationText(state.seconds));
  }
  return m_state.live ? QStringLiteral("%1: unknown").arg(process)
                      : QStringLiteral("%1: no message yet").arg(process);
}

void RobotCard::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return QFrame::mousePressEvent(event);
  if (chevronRect().contains(event->pos()))
    setCollapsed(!m_collapsed);
  else
    emit clicked(event->modifiers());
  m_pressed = event->pos();
  m_held = !chevronRect().contains(event->pos());
  m_dragging = false;
}

void RobotCard::mouseMoveEvent(QMouseEvent* event) {
  if (!m_held) return;
  if ((event->pos() - m_pressed).manhattanLength() >= QApplication::startDragDistance()) {
    m_dragging = true;
  }
  if (m_dragging) emit dragged(event->globalPosition().toPoint());
}

void RobotCard::mouseReleaseEvent(QMouseEvent* event) {
  m_held = false;
  if (std::exchange(m_dragging, false)) emit dropped(event->globalPosition().toPoint());
}

void RobotCard::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter)
    emit clicked(event->modifiers() & ~Qt::KeyboardModifiers(Qt::KeypadModifier));
  else
    QFrame::keyPressEvent(event);
}

void RobotCard::contextMenuEvent(QContextMenuEvent* event) {
  emit menuRequested(event->globalPos());
}

}  // namespace pitchboard::ui
