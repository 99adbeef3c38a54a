// SPDX-License-Identifier: GPL-3.0-or-later
// How a card looks (mock/card.png): all lengths are of the mock and follow the font.
#include <QPaintEvent>
#include <QPainter>
#include <QPainterPath>
#include <cmath>

#include <ui/base/elide_text.h>
#include <ui/base/quick_painting.h>
#include <ui/base/robot_text.h>
#include <ui/base/theme.h>
#include <ui/robots/robot_card.h>

namespace pitchboard::ui {
namespace {

constexpr double corner = 3.0;

QRectF sharp(const QRect& rect) {
  return QRectF(rect).adjusted(0.5, 0.5, -0.5, -0.5);
}

QString voltsText(const telemetry::Battery& battery) {
  return battery.volts > 0.0 ? numberText(battery.volts, 1) + QStringLiteral(" V")
                             : numberText(battery.fraction * 100.0, 0) + QStringLiteral(" %");
}

}  // namespace

QRect RobotCard::rowRect(int row) const {
  const int left = scaled(this, 9), wide = width() - left - scaled(this, 8);
  int top = 5;
  for (int above = 0; above < row; ++above) top += rowHeight(above);
  const int gap = row == 0 ? 4 : row == 1 ? 5 : 0;
  return {left, scaled(this, top), wide, scaled(this, std::max(0, rowHeight(row) - gap))};
}

int RobotCard::rowHeight(int row) const {
  if (row == 0) return 24;
  if (row == 1) return m_parts.processes || !m_state.tag.isEmpty() ? 21 : 0;
  if (row == 2) return m_parts.action || m_parts.health ? 19 : 0;
  return 16;
}

/// Lamps and battery make room for text and volts.
bool RobotCard::isNarrow() const {
  return width() < scaled(this, 232);
}

QRect RobotCard::lampRect(int lamp) const {
  if (m_collapsed) {
    const QRect row = rowRect(0);
    return {row.left() + scaled(this, 61 + lamp * 10), row.top() + scaled(this, 5), scaled(this, 7),
            scaled(this, 10)};
  }
  const QRect row = rowRect(1);
  const int step = isNarrow() ? 18 : 24, wide = isNarrow() ? 16 : 20;
  return {row.left() + scaled(this, lamp * step), row.top(), scaled(this, wide), row.height()};
}

QRect RobotCard::chevronRect() const {
  const QRect row = rowRect(0);
  return {row.right() - scaled(this, 16), row.top(), scaled(this, 20), row.height()};
}

QRect RobotCard::batteryRect() const {
  const int wide = scaled(this, isNarrow() ? 18 : 36);
  return {chevronRect().left() - scaled(this, 4) - wide, rowRect(0).center().y() - scaled(this, 4),
          wide, scaled(this, 10)};
}

QRect RobotCard::voltsRect() const {
  const QRect row = rowRect(0);
  const int right = batteryRect().left() - scaled(this, 6), wide = scaled(this, 48);
  return {right - wide, row.top(), wide, row.height()};
}

QRect RobotCard::tagRect() const {
  const QFontMetrics metrics(themeFont(TypeRole::Small, true));
  const int wanted = metrics.horizontalAdvance(m_state.tag) + scaled(this, 12);
  if (m_collapsed) {
    const QRect row = rowRect(0);
    const int left = lampRect(0).left() - scaled(this, 4);
    int right = chevronRect().left();
    if (m_state.battery && m_parts.battery) {
      // A tag that is cut off says nothing: it may lie where the volts are, the bar stays.
      right = left + wanted < voltsRect().left() ? voltsRect().left() : batteryRect().left();
    }
    return {left, row.top(), std::min(wanted, right - left - scaled(this, 2)), row.height()};
  }
  const QRect row = rowRect(1);
  const int room = m_parts.processes
                       ? row.right() - lampRect(CardState::lampCount - 1).right() - scaled(this, 4)
                       : row.width();
  const int wide = std::min(wanted, room);
  return {row.right() - wide + 1, row.top(), wide, row.height()};
}

bool RobotCard::showsTag() const {
  const bool shownByBar = m_collapsed && m_state.tagIsBattery && m_parts.battery;
  return m_state.tagKind != TagKind::None && !shownByBar;
}

void RobotCard::paintEvent(QPaintEvent* event) {
  QPainter painter(this);
  if (!m_collapsed && rowRect(2).contains(event->rect())) {
    // Ten times a second for every robot: frame, lamps and bar are as they were.
    painter.fillRect(event->rect(), m_state.timedOut ? theme().view : theme().window);
    paintFoot(painter);
    return;
  }
  painter.setRenderHint(QPainter::Antialiasing);
  paintFrame(painter);
  paintHead(painter);
  const bool alarm = showsTag();
  if (!m_collapsed || !alarm) paintLamps(painter);
  if (alarm) paintTag(painter);
  if (m_collapsed) return;
  paintFoot(painter);
  paintValues(painter);
}

void RobotCard::paintFrame(QPainter& painter) const {
  drawRoundBox(painter, rect(), corner, m_state.timedOut ? theme().view : theme().window,
               m_selected || hasFocus() ? theme().accentLine : theme().innerLine);
  // A collapsed card has no room for more than its tag; the edge is seen from afar.
  const bool alarm = m_collapsed && m_state.tagKind != TagKind::None;
  if (m_selected || alarm) {
    QPainterPath outline;
    outline.addRoundedRect(rect(), corner, corner);
    painter.save();
    painter.setClipPath(outline);
    const QColor edge = !alarm                              ? theme().accentLine
                        : m_state.tagKind == TagKind::Error ? theme().errorText
                                                            : theme().warningText;
    painter.fillRect(0, 0, scaled(this, 3), height(), edge);
    painter.restore();
  }
}

void RobotCard::paintHead(QPainter& painter) const {
  const double greyed = m_state.timedOut ? 0.5 : 1.0;
  painter.setOpacity(greyed);
  const QRect row = rowRect(0);
  const QRect badge(row.left(), row.top(), row.height(), row.height());
  drawRoundBox(painter, badge, corner, theme().team(m_state.team));
  painter.setFont(themeFont(TypeRole::Body, true));
  painter.setPen(Qt::white);
  drawTextLine(painter, badge, Qt::AlignCenter, QString::number(m_state.number));
  painter.setPen(theme().text);
  int end = chevronRect().left();
  if (m_collapsed) {
    end = lampRect(0).left();
  } else if (m_state.battery && m_parts.battery) {
    const QFontMetrics volts(themeFont(TypeRole::Body, m_state.batteryLow()));
    end = voltsRect().right() - volts.horizontalAdvance(voltsText(*m_state.battery));
  }
  QRect name = row.adjusted(row.height() + scaled(this, 8), 0, 0, 0);
  name.setRight(end - scaled(this, 4));
  const bool hasRoom = painter.fontMetrics().horizontalAdvance(m_state.name) <= name.width();
  const QString& shownName =
      m_collapsed && !hasRoom && !m_state.apart.isEmpty() ? m_state.apart : m_state.name;
  drawTextLine(painter, name, Qt::AlignLeft | Qt::AlignVCenter, shownName, Qt::ElideRight);
  if (!m_collapsed && !m_state.subtitle.isEmpty()) {
    const int taken = painter.fontMetrics().horizontalAdvance(m_state.name) + scaled(this, 8);
    const QRect room(name.left() + taken, name.top(), end - name.left() - taken, name.height());
    painter.setFont(themeFont(TypeRole::Secondary));
    painter.setPen(theme().secondaryText);
    const QString shown = painter.fontMetrics().elidedText(m_state.subtitle, Qt::ElideRight,
                                                           room.width() - scaled(this, 4));
    constexpr qsizetype legible = 8;  // fewer letters of a longer name say nothing
    if (shown == m_state.subtitle || shown.size() > legible)
      drawTextLine(painter, room, Qt::AlignLeft | Qt::AlignVCenter, shown);
  }

  painter.setOpacity(1.0);
  painter.setPen(theme().secondaryText);
  painter.setFont(themeFont(TypeRole::Small));
  drawTextLine(painter, chevronRect(), Qt::AlignCenter,
               m_collapsed ? QStringLiteral("▸") : QStringLiteral("▾"));

  if (!m_state.battery || !m_parts.battery) return;
  painter.setOpacity(greyed);
  const bool low = m_state.batteryLow();
  const QRect bar = batteryRect();
  const QColor color = low ? theme().errorText : theme().secondaryText;
  painter.setPen(color);
  painter.setBrush(Qt::NoBrush);
  painter.drawRoundedRect(sharp(bar), 1.5, 1.5);
  QRectF inside = QRectF(bar).adjusted(2, 2, -2, -2);
  inside.setWidth(inside.width() * m_state.battery->fraction);
  painter.fillRect(inside, color);
  painter.setOpacity(1.0);
  const QFont font = themeFont(TypeRole::Body, low);
  const QString volts = voltsText(*m_state.battery);
  if (m_collapsed) {
    // The bar says it as well; a number that lies under something else says nothing.
    const int taken = showsTag() ? tagRect().right()
                                 : lampRect(CardState::lampCount - 1).right() + scaled(this, 4);
    if (taken > voltsRect().right() - QFontMetrics(font).horizontalAdvance(volts)) return;
  }
  painter.setOpacity(greyed);
  painter.setFont(font);
  painter.setPen(low ? theme().errorText : theme().text);
  drawTextLine(painter, voltsRect(), Qt::AlignRight | Qt::AlignVCenter, volts);
  painter.setOpacity(1.0);
}

void RobotCard::paintLamps(QPainter& painter) const {
  if (!m_parts.processes) return;
  for (int i = 0; i < CardState::lampCount; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const LampState state = m_state.lamps[index].state;
    const QRect box = lampRect(i);
    if (state == LampState::Working) {
      drawRoundBox(painter, box, 2, m_collapsed ? theme().workingMark : theme().workingGround);
      painter.setPen(theme().workingText);
    } else if (state == LampState::NotResponding) {
      painter.setPen(theme().errorText);
      painter.setBrush(theme().errorGround);
      painter.drawRoundedRect(sharp(box), 2, 2);
    } else {
      QPen dashes(theme().disabledText, 1);
      // Short enough that every side, corners included, shows some.
      dashes.setDashPattern({2, 2});
      dashes.setCapStyle(Qt::FlatCap);
      painter.setPen(dashes);
      painter.setBrush(Qt::NoBrush);
      painter.drawRoundedRect(sharp(box), 2, 2);
      painter.setPen(theme().disabledText);
    }
    if (m_collapsed) continue;
    painter.setFont(themeFont(TypeRole::Small, true));
    drawTextLine(painter, box, Qt::AlignCenter, QString(QLatin1Char(CardState::letters[index])));
    if (state != LampState::NotResponding) continue;
    const int inset = box.width() / 4;
    const int middle = box.center().y();
    painter.drawLine(box.left() + inset, middle, box.right() - inset, middle);
  }
}

void RobotCard::paintTag(QPainter& painter) const {
  const bool error = m_state.tagKind == TagKind::Error;
  painter.setFont(themeFont(TypeRole::Small, true));
  const QRect box = tagRect();
  drawRoundBox(painter, box, 2, error ? theme().errorGround : theme().warningGround);
  painter.setPen(error ? theme().errorText : theme().warningText);
  const int edge = scaled(this, 3);
  drawTextLine(painter, box.adjusted(edge, 0, -edge, 0), Qt::AlignCenter, m_state.tag,
               Qt::ElideRight);
}

void RobotCard::paintFoot(QPainter& painter) const {
  const QRect row = rowRect(2);
  painter.setFont(themeFont(TypeRole::Secondary));
  painter.setPen(theme().secondaryText);
  const QString detail = m_parts.health ? m_state.detail : QString();
  drawTextLine(painter, row, Qt::AlignRight | Qt::AlignVCenter, detail);
  if (!m_parts.action) return;
  const int taken =
      static_cast<int>(std::ceil(textLineWidth(painter.font(), detail))) + scaled(this, 8);
  painter.setFont(themeFont(TypeRole::Body));
  painter.setPen(m_state.timedOut ? theme().disabledText : theme().text);
  const QRect room = row.adjusted(0, 0, -taken, 0);
  drawTextLine(painter, room, Qt::AlignLeft | Qt::AlignVCenter, m_state.action, Qt::ElideRight);
}

const CardValue* RobotCard::value(const QString& name) const {
  for (const CardValue& known : m_state.values) {
    if (name == known.name) return &known;
  }
  return nullptr;
}

void RobotCard::paintValues(QPainter& painter) const {
  painter.setFont(themeFont(TypeRole::Secondary));
  const int unitWidth = scaled(this, 40);
  for (qsizetype i = 0; i < m_parts.values.size(); ++i) {
    const QRect row = rowRect(3 + static_cast<int>(i));
    const CardValue* known = value(m_parts.values[i]);
    const bool greyed = known == nullptr || m_state.timedOut;
    painter.setPen(theme().secondaryText);
    // The number is whole; the name has what is left.
    const double taken =
        known ? textLineWidth(painter.font(), known->text) + unitWidth + scaled(this, 6) : 0.0;
    drawTextLine(painter, row, Qt::AlignLeft | Qt::AlignVCenter,
                 elideName(QFontMetricsF(painter.font()), known ? known->name : m_parts.values[i],
                           row.width() - taken));
    if (known == nullptr) continue;
    drawTextLine(painter, row.adjusted(row.width() - unitWidth + scaled(this, 4), 0, 0, 0),
                 Qt::AlignLeft | Qt::AlignVCenter, known->unit);
    painter.setPen(greyed ? theme().disabledText : theme().text);
    drawTextLine(painter, row.adjusted(0, 0, -unitWidth, 0), Qt::AlignRight | Qt::AlignVCenter,
                 known->text);
  }
}

}  // namespace pitchboard::ui
