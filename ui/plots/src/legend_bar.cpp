// SPDX-License-Identifier: GPL-3.0-or-later
#include "legend_bar.h"

#include <QContextMenuEvent>
#include <QHelpEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <cmath>

#include <ui/base/quick_painting.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {
constexpr int rowHeight = 16;  // px of the mock
constexpr int strokeLength = 12;
constexpr int gapAfterStroke = 5;
constexpr int gapBetween = 24;

int textWidth(const QFont& font, const QString& text) {
  return static_cast<int>(std::ceil(wordsWidth(font, text)));
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

void LegendBar::setLeft(int x, int right) {
  if (x == m_left && right == m_right) return;
  m_left = x;
  m_right = right;
  arrange();
}

void LegendBar::arrange() {
  const QFont font = themeFont(TypeRole::Small);
  const int height = scaled(this, rowHeight);
  // Room for a long number, so that entries do not move while values run.
  const int room = textWidth(font, QStringLiteral("\u22120000.00"));
  const int limit = qMax(width() - m_right, m_left + scaled(this, 80));
  int x = m_left;
  int y = 0;
  if (!m_title.isEmpty()) {
    x += textWidth(themeFont(TypeRole::Small, true), m_title) + scaled(this, 16);
  }
  m_rects.clear();
  for (const LegendEntry& entry : m_entries) {
    const int value =
        entry.value.isEmpty() ? 0 : qMax(room, textWidth(font, entry.value)) + scaled(this, 6);
    const int wide = scaled(this, strokeLength + gapAfterStroke) + textWidth(font, entry.text) +
                     value + scaled(this, 4);
    if (x > m_left && x + wide > limit) {
      x = m_left;
      y += height;
    }
    m_rects << QRect(x, y, qMin(wide, limit - x), height);
    x += wide + scaled(this, gapBetween);
  }
  if (y + height != minimumHeight()) setFixedHeight(y + height);
  update();
}

void LegendBar::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const ThemeColors& colors = theme();
  const QFont font = themeFont(TypeRole::Small);
  if (!m_title.isEmpty()) {
    painter.setFont(themeFont(TypeRole::Small, true));
    painter.setPen(colors.text);
    painter.drawText(QRect(m_left, 0, width() - m_left, scaled(this, rowHeight)),
                     Qt::AlignLeft | Qt::AlignVCenter, m_title);
  }
  painter.setFont(font);
  for (qsizetype i = 0; i < m_entries.size(); ++i) {
    const LegendEntry& entry = m_entries[i];
    QRect rect = m_rects.value(i);
    const int stroke = scaled(this, strokeLength);
    painter.fillRect(QRectF(rect.left(), rect.center().y(), stroke, scaled(this, 2)),
                     entry.muted ? colors.disabledText : entry.color);
    rect.setLeft(rect.left() + scaled(this, strokeLength + gapAfterStroke));
    painter.setPen(entry.faulty  ? colors.errorText
                   : entry.muted ? colors.disabledText
                                 : colors.text);
    // Where there is no room for both, the name is cut and not the value.
    const int gap = scaled(this, 6);
    const int value = entry.value.isEmpty() ? 0 : textWidth(font, entry.value) + gap;
    const int name = std::clamp(rect.width() - value, 0, textWidth(font, entry.text));
    drawWords(painter, QRect(rect.topLeft(), QSize(name, rect.height())),
              Qt::AlignLeft | Qt::AlignVCenter, entry.text, Qt::ElideRight);
    if (entry.value.isEmpty()) continue;
    painter.setPen(colors.secondaryText);
    rect.setLeft(rect.left() + name + gap);
    drawWords(painter, rect, Qt::AlignLeft | Qt::AlignVCenter, entry.value);
  }
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

void LegendBar::mouseDoubleClickEvent(QMouseEvent* event) {
  if (const int index = entryAt(event->position().toPoint()); index >= 0) emit activated(index);
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
