// SPDX-License-Identifier: GPL-3.0-or-later
#include "scoreboard.h"

#include <QFontMetrics>
#include <QPainter>
#include <cmath>

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
  setAccessibleName(QStringLiteral("%1 %2 %3, %4, %5")
                        .arg(state.leftName, scoreText(state), state.rightName,
                             (state.clock + QLatin1Char(' ') + state.period).trimmed(),
                             state.state));
  update();
}

// Of the fonts and the window only: whatever the match says, nothing beside it moves.
Scoreboard::Widths Scoreboard::widths() const {
  const int window = this->window()->width();
  const bool narrow = window < scaled(this, 1100), wide = window >= scaled(this, 1600);
  Widths widths{};
  widths.names = narrow ? themeFont(TypeRole::Body, true) : themeFont(TypeRole::Score);
  const QFontMetricsF names(widths.names), score(themeFont(TypeRole::Score)),
      period(themeFont(TypeRole::Secondary));
  const auto wide8 = [](const QFontMetricsF& font, const char* text) {
    return static_cast<int>(std::ceil(font.horizontalAdvance(QLatin1String(text))));
  };
  widths.name = scaled(this, narrow ? 40 : wide ? 150 : 76);
  widths.score = wide8(score, "88 : 88");
  widths.clock = wide8(names, "88:88") + scaled(this, 2);
  // A narrow window has it below the clock.
  widths.period = narrow ? 0 : wide8(period, "ET 8");
  widths.tag = scaled(this, narrow ? 100 : wide ? 180 : 132);
  widths.gap = scaled(this, narrow ? 5 : 8);
  return widths;
}

QSize Scoreboard::sizeHint() const {
  const Widths w = widths();
  const int period = w.period > 0 ? w.period + w.gap / 2 : 0;
  return {2 * (w.name + scaled(this, square + 5)) + w.score + w.clock + period + w.tag + 4 * w.gap +
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
  // A clock beyond 99:59 gets smaller digits rather than dots.
  QFont clock = w.names;
  for (int size = QFontInfo(clock).pixelSize();
       size > 6 && QFontMetricsF(clock).horizontalAdvance(m_state.clock) > w.clock; --size) {
    clock.setPixelSize(size - 1);
  }
  const QFont period = themeFont(TypeRole::Secondary);
  if (w.period > 0) {
    word(take(w.clock, w.gap / 2), m_state.clock, clock, Qt::AlignHCenter);
    word(take(w.period, w.gap), m_state.period, period, Qt::AlignLeft);
  } else {
    const QRect place = take(w.clock, w.gap);
    const int below = m_state.period.isEmpty() ? 0 : px(11);
    word(place.adjusted(0, 0, 0, -below), m_state.clock, clock, Qt::AlignHCenter);
    word(place.adjusted(0, place.height() - below - px(1), 0, -px(1)), m_state.period, period,
         Qt::AlignHCenter);
  }
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
