// SPDX-License-Identifier: GPL-3.0-or-later
#include "scoreboard.h"

#include <QFontMetrics>
#include <QPainter>

#include <ui/base/elide_text.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

constexpr int square = 10;  // px of the mock

QString scoreText(const ScoreboardState& state) {
  return QStringLiteral("%1 : %2").arg(state.left).arg(state.right);
}

}  // namespace

Scoreboard::Scoreboard(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("scoreboard"));
}

void Scoreboard::setState(const ScoreboardState& state) {
  if (state == m_state) return;
  m_state = state;
  setToolTip(state.tip.isEmpty() ? QStringLiteral("Score, time and game state") : state.tip);
  setAccessibleName(
      QStringLiteral("%1 %2 %3, %4, %5")
          .arg(state.leftName, scoreText(state), state.rightName, state.clock, state.state));
  update();
}

// Of the fonts and the window only: whatever the match says, nothing beside it moves.
Scoreboard::Widths Scoreboard::widths() const {
  const int window = this->window()->width();
  const bool narrow = window < scaled(this, 1100), wide = window >= scaled(this, 1600);
  Widths widths{};
  widths.names = narrow ? themeFont(TypeRole::Body, true) : themeFont(TypeRole::Score);
  const QFontMetrics names(widths.names), score(themeFont(TypeRole::Score));
  widths.name = scaled(this, narrow ? 40 : wide ? 150 : 76);
  widths.score = score.horizontalAdvance(QStringLiteral("88 : 88"));
  widths.clock = names.horizontalAdvance(QStringLiteral("88:88")) + scaled(this, 2);
  widths.tag = scaled(this, narrow ? 100 : wide ? 180 : 132);
  widths.gap = scaled(this, narrow ? 5 : 8);
  return widths;
}

QSize Scoreboard::sizeHint() const {
  const Widths w = widths();
  return {2 * (w.name + scaled(this, square + 5)) + w.score + w.clock + w.tag + 4 * w.gap +
              scaled(this, 4),
          scaled(this, 28)};
}

void Scoreboard::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const auto px = [this](double pixels) { return scaled(this, pixels); };
  const Widths w = widths();
  const QRect all(width() - sizeHint().width(), 0, sizeHint().width(), height());
  int left = all.left();
  const auto take = [&](int wide, int gap) {
    const QRect place(left, 0, wide, height());
    left += wide + gap;
    return place;
  };
  const auto word = [&](const QRect& place, const QString& text, const QFont& font, int align) {
    painter.setFont(font);
    painter.setPen(theme().text);
    const QString shown = elideText(QFontMetricsF(font), text, place.width());
    painter.drawText(place, align | Qt::AlignVCenter, shown);
    return QFontMetrics(font).horizontalAdvance(shown);
  };
  const auto colourAt = [&](int x, const QColor& colour) {
    if (!colour.isValid()) return;
    const int side = px(square);
    const QRect box(x, (height() - side) / 2, side, side);
    painter.fillRect(box, colour);
    // White on white and black on black must be seen.
    painter.setPen(theme().secondaryText);
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(box.adjusted(0, 0, -1, -1));
  };
  // Names stand against the score, whatever their length.
  left += px(square + 5);
  const QRect leftName = take(w.name, w.gap);
  const int leftWide = word(leftName, m_state.leftName, w.names, Qt::AlignRight);
  colourAt(leftName.right() + 1 - leftWide - px(square + 5), m_state.leftColour);
  const QRect score = take(w.score, w.gap);
  if (!m_state.leftName.isEmpty())
    word(score, scoreText(m_state), themeFont(TypeRole::Score), Qt::AlignHCenter);
  const QRect rightName = take(w.name, px(square + 5) + w.gap);
  const int rightWide = word(rightName, m_state.rightName, w.names, Qt::AlignLeft);
  colourAt(rightName.left() + rightWide + px(5), m_state.rightColour);
  painter.fillRect(QRect(left - 2 * w.gap / 3, px(4), 1, height() - px(8)), theme().innerLine);
  word(take(w.clock, w.gap), m_state.clock, w.names, Qt::AlignHCenter);
  if (m_state.state.isEmpty()) return;
  const QFont tagFont = themeFont(TypeRole::Secondary, true);
  const QRect place = take(w.tag, 0);
  const int top = (height() - px(20)) / 2;
  const QRectF tag(place.left() + 0.5, top + 0.5, place.width() - 1, px(20) - 1);
  painter.setPen(theme().innerLine);
  painter.setBrush(theme().button);
  painter.drawRoundedRect(tag, 3, 3);
  const QRect inside = place.adjusted(px(6), 0, -px(6), 0);
  word(inside, stateText(m_state, QFontMetricsF(tagFont), inside.width()), tagFont,
       Qt::AlignHCenter);
}

}  // namespace pitchboard::ui
