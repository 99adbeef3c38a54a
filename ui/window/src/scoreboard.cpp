// SPDX-License-Identifier: GPL-3.0-or-later
#include "scoreboard.h"

#include <QFontMetrics>
#include <QPainter>

#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

QString scoreText(const ScoreboardState& state) {
  return QStringLiteral("%1 : %2").arg(state.left).arg(state.right);
}

}  // namespace

Scoreboard::Scoreboard(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("scoreboard"));
}

void Scoreboard::setState(const ScoreboardState& state) {
  if (state == m_state) return;
  const QSize before = sizeHint();
  m_state = state;
  if (sizeHint() != before) updateGeometry();
  setToolTip(state.tip.isEmpty() ? QStringLiteral("Score, time of play and state of the game")
                                 : state.tip);
  setAccessibleName(
      QStringLiteral("%1 %2 %3, %4, %5")
          .arg(state.leftName, scoreText(state), state.rightName, state.clock, state.state));
  update();
}

QSize Scoreboard::sizeHint() const {
  const QFontMetrics score(themeFont(TypeRole::Score));
  const QFontMetrics tag(themeFont(TypeRole::Secondary, true));
  const int words = score.horizontalAdvance(m_state.leftName + scoreText(m_state) +
                                            m_state.rightName + m_state.clock);
  const int penalties =
      m_state.penalties.isEmpty() ? 0 : tag.horizontalAdvance(m_state.penalties) + scaled(this, 12);
  return {words + penalties + tag.horizontalAdvance(m_state.state) +
              scaled(this, 2 * 10 + 5 * 8 + 4 * 12 + 16),
          scaled(this, 28)};
}

void Scoreboard::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const auto px = [this](double pixels) { return scaled(this, pixels); };
  int right = width() - px(4);

  const QFont tagFont = themeFont(TypeRole::Secondary, true);
  const int tagWidth = QFontMetrics(tagFont).horizontalAdvance(m_state.state) + px(16);
  const QRectF tag(right - tagWidth + 0.5, (height() - px(20)) / 2 + 0.5, tagWidth - 1, px(20) - 1);
  painter.setPen(theme().innerLine);
  painter.setBrush(theme().button);
  painter.drawRoundedRect(tag, 3, 3);
  painter.setFont(tagFont);
  painter.setPen(theme().text);
  painter.drawText(tag, Qt::AlignCenter, m_state.state);
  right -= tagWidth + px(8);
  if (!m_state.penalties.isEmpty()) {
    const int wide = QFontMetrics(tagFont).horizontalAdvance(m_state.penalties);
    painter.setPen(theme().warningText);
    painter.drawText(QRect(right - wide, 0, wide, height()), Qt::AlignVCenter, m_state.penalties);
    painter.setPen(theme().text);
    right -= wide + px(12);
  }

  const QFont font = themeFont(TypeRole::Score);
  const QFontMetrics metrics(font);
  painter.setFont(font);
  const auto word = [&](const QString& text, int gap) {
    const int wide = metrics.horizontalAdvance(text);
    painter.drawText(QRect(right - wide, 0, wide, height()), Qt::AlignVCenter, text);
    right -= wide + px(gap);
  };
  const auto square = [&](const QColor& colour, int gap) {
    const int side = px(10);
    const QRect box(right - side, (height() - side) / 2, side, side);
    if (colour.isValid()) {
      painter.fillRect(box, colour);
      // White on white and black on black must be seen.
      painter.setPen(theme().secondaryText);
      painter.setBrush(Qt::NoBrush);
      painter.drawRect(box.adjusted(0, 0, -1, -1));
      painter.setPen(theme().text);
    }
    right -= side + px(gap);
  };
  word(m_state.clock, 12);
  painter.fillRect(QRect(right, px(4), 1, height() - px(8)), theme().innerLine);
  right -= px(12);
  square(m_state.rightColour, 8);
  word(m_state.rightName, 12);
  if (!m_state.leftName.isEmpty()) word(scoreText(m_state), 12);
  word(m_state.leftName, 8);
  square(m_state.leftColour, 0);
}

}  // namespace pitchboard::ui
