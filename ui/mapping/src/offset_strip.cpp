// SPDX-License-Identifier: GPL-3.0-or-later
#include "offset_strip.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>

#include <ui/base/elide_text.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {

OffsetStrip::OffsetStrip(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("mappingOffsets"));
  setAccessibleName(QStringLiteral("Recordings on one clock"));
  setFocusPolicy(Qt::StrongFocus);
  setCursor(Qt::SizeHorCursor);
  setToolTip(
      QStringLiteral("Drag a recording to where it belongs. Arrow keys move the chosen one by 10 "
                     "ms, with Shift by 1 s"));
}

void OffsetStrip::setRecordings(const std::vector<link::SampledRecording>& recordings) {
  m_recordings = recordings;
  m_current = std::min(m_current, recordings.empty() ? 0 : recordings.size() - 1);
  m_begin = 0.0;
  m_end = 0.001;
  for (const link::SampledRecording& one : recordings) {
    m_begin = std::min(m_begin, one.begin);
    m_end = std::max(m_end, one.end);
  }
  const double margin = 0.05 * (m_end - m_begin);
  m_begin -= margin;
  m_end += margin;
  updateGeometry();
  update();
}

double OffsetStrip::pixelsPerSecond() const {
  return std::max(1, width()) / (m_end - m_begin);
}

int OffsetStrip::rowHeight() const {
  return scaled(this, 22);
}

QSize OffsetStrip::sizeHint() const {
  return {scaled(this, 300), rowHeight() * std::max(1, static_cast<int>(m_recordings.size()))};
}

QRectF OffsetStrip::barOf(std::size_t recording) const {
  const link::SampledRecording& one = m_recordings[recording];
  const double by = m_isDragged && recording == m_current ? m_dragged : 0.0;
  const double left = (one.begin + by - m_begin) * pixelsPerSecond();
  const double length = std::max(2.0, (one.end - one.begin) * pixelsPerSecond());
  return {left, static_cast<double>(recording) * rowHeight() + 2.0, length, rowHeight() - 4.0};
}

void OffsetStrip::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), theme().view);
  for (std::size_t i = 0; i < m_recordings.size(); ++i) {
    const QRectF bar = barOf(i);
    const bool isCurrent = i == m_current && hasFocus();
    painter.setPen(isCurrent ? theme().accentLine : theme().outerEdge);
    painter.setBrush(isCurrent ? theme().selectedRow : theme().button);
    painter.drawRoundedRect(bar, 3.0, 3.0);
    const link::MappedRecording& timing = m_recordings[i].timing;
    const double offset = timing.offset + (m_isDragged && i == m_current ? m_dragged : 0.0);
    QString text = QString::fromStdString(timing.file);
    if (offset != 0.0)
      text += QStringLiteral("  %1%2 s").arg(offset > 0 ? "+" : "").arg(offset, 0, 'f', 2);
    painter.setPen(theme().text);
    // A bar at the right edge has its text before it.
    const double last = width() - painter.fontMetrics().horizontalAdvance(text) - 6.0;
    const double left = std::max(std::min(bar.left() + 6.0, last), 6.0);
    const QRectF room(left, bar.top(), width(), bar.height());
    painter.drawText(room, Qt::AlignVCenter | Qt::AlignLeft, text);
  }
}

void OffsetStrip::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || m_recordings.empty()) return;
  const auto row = static_cast<std::size_t>(std::max(0.0, event->position().y()) / rowHeight());
  m_current = std::min(row, m_recordings.size() - 1);
  m_isDragged = true;
  m_pressedAt = event->position().x();
  m_dragged = 0.0;
  update();
}

void OffsetStrip::mouseMoveEvent(QMouseEvent* event) {
  if (!m_isDragged) return;
  m_dragged = (event->position().x() - m_pressedAt) / pixelsPerSecond();
  update();
}

void OffsetStrip::mouseReleaseEvent(QMouseEvent*) {
  if (!std::exchange(m_isDragged, false)) return;
  update();
  if (m_dragged != 0.0) emit moved(m_current, m_dragged);
}

void OffsetStrip::keyPressEvent(QKeyEvent* event) {
  const double step = event->modifiers().testFlag(Qt::ShiftModifier) ? 1.0 : 0.01;
  const bool isRow = event->key() == Qt::Key_Up || event->key() == Qt::Key_Down;
  if (m_isDragged && event->key() == Qt::Key_Escape) {
    m_isDragged = false;
    m_dragged = 0.0;
  } else if (m_recordings.empty()) {
    return QWidget::keyPressEvent(event);
  } else if (isRow) {
    const bool isDown = event->key() == Qt::Key_Down;
    m_current = isDown ? std::min(m_current + 1, m_recordings.size() - 1)
                       : m_current - (m_current > 0 ? 1 : 0);
  } else if (event->key() == Qt::Key_Left || event->key() == Qt::Key_Right) {
    emit moved(m_current, event->key() == Qt::Key_Left ? -step : step);
  } else {
    return QWidget::keyPressEvent(event);
  }
  update();
}

}  // namespace pitchboard::ui
