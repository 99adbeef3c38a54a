// SPDX-License-Identifier: GPL-3.0-or-later
#include "legend_bar.h"

#include <QContextMenuEvent>
#include <QHelpEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <array>
#include <cmath>

#include <ui/base/quick_painting.h>
#include <ui/base/theme.h>

#include "curve.h"

namespace pitchboard::ui {
namespace {
constexpr int rowHeight = 16;  // px of the mock
constexpr int strokeLength = 12;
constexpr int gapAfterStroke = 5;
constexpr int gapInEntry = 6;
constexpr int gapBetween = 24;

int textWidth(const QFont& font, const QString& text) {
  return static_cast<int>(std::ceil(textLineWidth(font, text)));
}
}  // namespace

LegendBar::LegendBar(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  setFixedHeight(scaled(this, rowHeight));
}

void LegendBar::setTitle(const QString& title) {
  if (title == m_title) return;
  m_title = title;
  arrange();
}

void LegendBar::setEntries(const QList<LegendEntry>& entries) {
  if (entries == m_entries) return;
  m_entries = entries;
  arrange();
}

void LegendBar::setEdges(int left, int right) {
  if (left == m_left && right == m_right) return;
  m_left = left;
  m_right = right;
  arrange();
}

void LegendBar::setUnits(const QString& left, const QString& right) {
  if (left == m_leftUnit && right == m_rightUnit) return;
  m_leftUnit = left;
  m_rightUnit = right;
  update();
}

void LegendBar::setFirst(int index) {
  const int last = qMax(0, static_cast<int>(m_entries.size()) - 1);
  index = std::clamp(index, 0, last);
  if (index == m_first) return;
  m_first = index;
  arrange();
}

void LegendBar::reveal(int index) {
  if (index >= 0 && index < m_entries.size() && m_rects.value(index).isEmpty()) setFirst(index);
}

int LegendBar::widthOf(const LegendEntry& entry) const {
  const QFont font = themeFont(TypeRole::Small);
  // Room for a long number, so that entries do not move while values run.
  const int room = textWidth(font, QStringLiteral("\u22120000.00"));
  const auto part = [&](const QString& text, int least) {
    return text.isEmpty() ? 0 : qMax(least, textWidth(font, text)) + scaled(this, gapInEntry);
  };
  return scaled(this, strokeLength + gapAfterStroke) + textWidth(font, entry.text) +
         part(entry.side, 0) + part(entry.value, room) + scaled(this, 4);
}

void LegendBar::arrange() {
  const int height = scaled(this, rowHeight), gap = scaled(this, gapBetween);
  int left = m_left;
  if (!m_title.isEmpty()) {
    left += textWidth(themeFont(TypeRole::Small, true), m_title) + scaled(this, 16);
  }
  const int right = qMax(width() - m_right, left + scaled(this, 80));
  int all = -gap;
  for (const LegendEntry& entry : std::as_const(m_entries)) all += widthOf(entry) + gap;
  m_back = m_on = {};
  int limit = right;
  if (m_entries.size() > 1 && all > right - left) {
    m_on = QRect(right - height, 0, height, height);
    m_back = m_on.translated(-height, 0);
    limit = m_back.left() - scaled(this, 4);
  } else {
    m_first = 0;
  }
  m_first = std::clamp(m_first, 0, qMax(0, static_cast<int>(m_entries.size()) - 1));
  m_rects.fill({}, m_entries.size());
  int x = left;
  m_last = m_first;
  for (int i = m_first; i < m_entries.size(); ++i) {
    const int wide = widthOf(m_entries[i]);
    // A whole entry or none, but for one that is too wide by itself.
    if (i > m_first && x + wide > limit) break;
    m_rects[i] = QRect(x, 0, qMin(wide, limit - x), height);
    m_last = i;
    x += wide + gap;
  }
  update();
}

bool LegendBar::pressArrow(const QPoint& position) {
  if (m_back.contains(position)) {
    setFirst(m_first - 1);
    return true;
  }
  if (!m_on.contains(position)) return false;
  if (m_last + 1 < m_entries.size()) setFirst(m_first + 1);
  return true;
}

void LegendBar::wheelEvent(QWheelEvent* event) {
  if (m_on.isEmpty()) {
    event->ignore();
    return;
  }
  m_turned += event->angleDelta().y() != 0 ? event->angleDelta().y() : event->angleDelta().x();
  constexpr int notch = 120;
  const int steps = m_turned / notch;
  m_turned -= steps * notch;
  // To the last entry, not beyond it.
  for (int i = 0; i < -steps && m_last + 1 < m_entries.size(); ++i) setFirst(m_first + 1);
  if (steps > 0) setFirst(m_first - steps);
  event->accept();
}

void LegendBar::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const ThemeColors& colors = theme();
  const QFont font = themeFont(TypeRole::Small);
  const int height = scaled(this, rowHeight);
  if (!m_title.isEmpty()) {
    painter.setFont(themeFont(TypeRole::Small, true));
    painter.setPen(colors.text);
    painter.drawText(QRect(m_left, 0, width() - m_left, height), Qt::AlignLeft | Qt::AlignVCenter,
                     m_title);
  }
  painter.setFont(font);
  painter.setPen(colors.secondaryText);
  const int gap = scaled(this, gapInEntry);
  drawTextLine(painter, QRect(0, 0, m_left - gap, height), Qt::AlignRight | Qt::AlignVCenter,
               m_leftUnit);
  drawTextLine(painter, QRect(width() - m_right + gap, 0, m_right - gap, height),
               Qt::AlignLeft | Qt::AlignVCenter, m_rightUnit);
  for (qsizetype i = 0; i < m_entries.size(); ++i) {
    const LegendEntry& entry = m_entries[i];
    QRect rect = m_rects.value(i);
    if (rect.isEmpty()) continue;
    if (entry.pointedOut) {
      const int edge = scaled(this, 3);
      painter.fillRect(rect.adjusted(-edge, 0, edge, 0), colors.selectedRow);
    }
    const bool quiet = entry.muted || entry.hidden;
    QPen stroke(quiet ? colors.disabledText : entry.color, scaled(this, 2), Qt::SolidLine,
                Qt::FlatCap);
    const double y = rect.center().y() + scaled(this, 1);
    const double end = rect.left() + scaled(this, strokeLength);
    painter.setPen(stroke);
    const std::array<QPointF, 2> ends{QPointF(rect.left(), y), QPointF(end, y)};
    painter.drawLines(dashedLine(ends, entry.dash, scaled(this, 100) / 100.0, rect.left()));
    rect.setLeft(rect.left() + scaled(this, strokeLength + gapAfterStroke));
    painter.setPen(entry.faulty ? colors.errorText : quiet ? colors.disabledText : colors.text);
    // Where there is no room for all of it, the name is cut and not the value.
    const auto wide = [&](const QString& text) {
      return text.isEmpty() ? 0 : textWidth(font, text) + gap;
    };
    const int rest = wide(entry.value) + wide(entry.side);
    const int name = std::clamp(rect.width() - rest, 0, textWidth(font, entry.text));
    const QRect nameRect(rect.topLeft(), QSize(name, rect.height()));
    drawTextLine(painter, nameRect, Qt::AlignLeft | Qt::AlignVCenter, entry.text, Qt::ElideRight);
    if (entry.hidden) {
      painter.drawLine(nameRect.left(), nameRect.center().y() + 1, nameRect.right(),
                       nameRect.center().y() + 1);
    }
    rect.setLeft(rect.left() + name + gap);
    if (!entry.side.isEmpty()) {
      painter.setPen(entry.odd ? colors.warningText : colors.secondaryText);
      drawTextLine(painter, rect, Qt::AlignLeft | Qt::AlignVCenter, entry.side);
      rect.setLeft(rect.left() + wide(entry.side));
    }
    painter.setPen(colors.secondaryText);
    drawTextLine(painter, rect, Qt::AlignLeft | Qt::AlignVCenter, entry.value);
  }
  const auto arrow = [&](const QRect& at, const QString& sign, bool on) {
    if (at.isEmpty()) return;
    painter.setPen(on ? colors.text : colors.disabledText);
    painter.drawText(at, Qt::AlignCenter, sign);
  };
  arrow(m_back, QStringLiteral("\u2039"), m_first > 0);
  arrow(m_on, QStringLiteral("\u203a"), m_last + 1 < m_entries.size());
}

void LegendBar::resizeEvent(QResizeEvent*) {
  arrange();
}

int LegendBar::entryAt(const QPoint& position) const {
  for (qsizetype i = 0; i < m_rects.size(); ++i) {
    if (m_rects[i].contains(position)) return static_cast<int>(i);
  }
  return -1;
}

void LegendBar::contextMenuEvent(QContextMenuEvent* event) {
  emit menuRequested(entryAt(event->pos()), event->globalPos());
}

void LegendBar::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  const QPoint at = event->position().toPoint();
  if (pressArrow(at)) return;
  if (const int index = entryAt(at); index >= 0) emit toggled(index);
}

void LegendBar::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  const QPoint at = event->position().toPoint();
  if (pressArrow(at)) return;
  if (const int index = entryAt(at); index >= 0) emit isolated(index);
}

bool LegendBar::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    auto* help = static_cast<QHelpEvent*>(event);
    const int index = entryAt(help->pos());
    if (index < 0)
      QToolTip::hideText();
    else
      QToolTip::showText(help->globalPos(), m_entries[index].tip, this);
    return true;
  }
  if (event->type() == QEvent::FontChange || event->type() == QEvent::PaletteChange) arrange();
  return QWidget::event(event);
}

}  // namespace pitchboard::ui
