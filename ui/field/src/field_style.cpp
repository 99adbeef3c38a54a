// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_style.h"

#include <QFontMetricsF>
#include <QGuiApplication>
#include <QHash>
#include <algorithm>
#include <cmath>

#include <ui/base/quick_painting.h>
#include <ui/base/theme.h>

#include "field_stamps.h"

namespace pitchboard::ui {

double FieldStyle::atLeast(double length, double pixels) const {
  return std::max(length, pixels / pixelsPerMetre);
}

QRectF FieldStyle::playingArea() const {
  const double x = field.halfLength() + field.border;
  const double y = field.halfWidth() + field.border;
  return {-x, -y, 2 * x, 2 * y};
}

double FieldStyle::robotDrawRadius() const {
  return atLeast(field.robotRadius, minRobot_px());
}

double FieldStyle::ballDrawRadius() const {
  return atLeast(field.ballRadius, 3.0);
}

ScreenPainting::ScreenPainting(QPainter* painter, const QPointF& itemPoint)
    : m_painter(painter), m_before(painter->worldTransform()) {
  const QPointF origin = m_before.map(itemPoint);
  m_scale = std::hypot(m_before.m11(), m_before.m12());
  m_signX = m_before.m11() < 0 ? -1.0 : 1.0;
  m_signY = m_before.m22() < 0 ? -1.0 : 1.0;
  painter->setWorldTransform(QTransform::fromTranslate(origin.x(), origin.y()));
}

ScreenPainting::~ScreenPainting() {
  m_painter->setWorldTransform(m_before);
}

QPointF ScreenPainting::pixels(const QPointF& metres) const {
  return {metres.x() * m_scale * m_signX, metres.y() * m_scale * m_signY};
}

QPointF ScreenPainting::direction(double yaw) const {
  return {std::cos(yaw) * m_signX, std::sin(yaw) * m_signY};
}

const QFont& fieldFont(int pixelSize, bool bold) {
  static QHash<int, QFont> fonts;
  static QString family;
  const QFont base = QGuiApplication::font();
  if (family != base.family()) {
    family = base.family();
    fonts.clear();
  }
  const int key = pixelSize * 2 + (bold ? 1 : 0);
  auto found = fonts.find(key);
  if (found == fonts.end()) {
    QFont font = base;
    font.setPixelSize(std::max(1, pixelSize));
    font.setBold(bold);
    found = fonts.insert(key, font);
  }
  return *found;
}

QColor onGrass(const QColor& color, double opacity) {
  const QColor& ground = theme().grass;
  const auto mixed = [opacity](int above, int below) {
    return static_cast<int>(std::lround(opacity * above + (1.0 - opacity) * below));
  };
  return {mixed(color.red(), ground.red()), mixed(color.green(), ground.green()),
          mixed(color.blue(), ground.blue())};
}

void drawHaloText(QPainter* painter, const QPointF& centre, const QString& text, const QFont& font,
                  const QColor& color, const QColor& halo) {
  const QFontMetricsF metrics(font);
  const double width = textLineWidth(font, text);
  const auto kind = font.bold() ? Stamp::Kind::BoldText : Stamp::Kind::Text;
  drawStamp(painter, centre, {kind, font.pixelSize(), color.rgba(), halo.rgba(), text},
            {width / 2 + 3, metrics.height() / 2 + 3}, [&](QPainter& p) {
              const QPointF base(-width / 2, (metrics.ascent() - metrics.descent()) / 2);
              p.setFont(font);
              p.setPen(halo);
              for (const QPointF& shift :
                   {QPointF(-1, 0), QPointF(1, 0), QPointF(0, -1), QPointF(0, 1)}) {
                p.drawText(base + shift, text);
              }
              p.setPen(color);
              p.drawText(base, text);
            });
}

namespace {

const QFont& plateFont() {
  return fieldFont(11, true);
}

}  // namespace

QSizeF plateSize(const QString& text) {
  return {textLineWidth(plateFont(), text) + 10, QFontMetricsF(plateFont()).height() + 2};
}

void drawPlateText(QPainter* painter, const QPointF& centre, const QString& text) {
  const QSizeF size = plateSize(text);
  const QRectF box(-size.width() / 2, -size.height() / 2, size.width(), size.height());
  const QColor ground(16, 20, 24, 215);
  drawStamp(painter, centre, {Stamp::Kind::Plate, 0, ground.rgba(), 0, text},
            {size.width() / 2 + 1, size.height() / 2 + 1}, [&](QPainter& p) {
              p.setPen(Qt::NoPen);
              p.setBrush(ground);
              p.drawRoundedRect(box, 3, 3);
              p.setFont(plateFont());
              p.setPen(Qt::white);
              p.drawText(box, Qt::AlignCenter, text);
            });
}

QString fieldNumber(double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  const double rounded = std::round(value * scale) / scale;
  QString text = QString::number(std::abs(rounded), 'f', decimals);
  return rounded < 0 ? QChar(0x2212) + text : text;
}

}  // namespace pitchboard::ui
