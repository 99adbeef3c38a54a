// SPDX-License-Identifier: GPL-3.0-or-later
#include "sector_items.h"

#include <cmath>
#include <numbers>

#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

constexpr int starVarsGranularity = 8;
constexpr double starVarsReach = 2.5;  // metres; the rays have no end of their own
constexpr double delta = 1.0;          // metres, the elevation distance of EOPRA

QColor faint(double opacity) {
  return onGrass(theme().fieldLines, opacity);
}

QColor shade() {
  return theme().fieldBorder.darker(isDarkTheme() ? 130 : 170);
}

}  // namespace

std::vector<double> eopraRings(int granularity, double delta_m) {
  std::vector<double> rings;
  for (int e = 1; e <= granularity; ++e) rings.push_back(e * delta_m / granularity);
  for (int e = granularity + 1; e < 2 * granularity; ++e) {
    rings.push_back(delta_m * granularity / (2 * granularity - e));
  }
  return rings;
}

void SectorItem::setPose(const Pose& pose) {
  setPos(toScene(pose.position));
  if (pose.yaw == m_yaw) return;
  m_yaw = pose.yaw;
  update();
}

double SectorItem::reach() const {
  return m_kind == Kind::Eopra ? delta * m_style->eopraGranularity : starVarsReach;
}

QRectF SectorItem::boundingRect() const {
  const double r = reach() + m_style->metres(18.0);
  return {-r, -r, 2 * r, 2 * r};
}

void SectorItem::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) {
  painter->setClipRect(m_style->playingArea().translated(-pos()));
  paintSectors(painter);
  painter->setClipping(false);
}

void SectorItem::paintSectors(QPainter* painter) const {
  const ScreenPainting screen(painter, QPointF(0, 0));
  painter->setBrush(Qt::NoBrush);
  if (m_kind == Kind::Eopra) {
    paintEopra(painter, screen);
  } else {
    paintStarVars(painter, screen);
  }
}

void SectorItem::paintEopra(QPainter* painter, const ScreenPainting& screen) const {
  const double scale = screen.pixelsPerMetre();
  const int m = m_style->eopraGranularity;
  const double outer = reach() * scale;
  for (const double ring : eopraRings(m, delta)) {
    const bool elevation = std::abs(ring - delta) < 1e-9;
    painter->setPen(QPen(faint(elevation ? 0.75 : 0.35), elevation ? 1.6 : 1.0));
    painter->drawEllipse(QPointF(0, 0), ring * scale, ring * scale);
  }
  painter->setPen(QPen(faint(0.35), 1.0));
  const double sector = std::numbers::pi / m;
  for (int i = 0; i < 2 * m; ++i) {
    const QPointF ray = screen.direction(m_yaw + i * sector);
    painter->setPen(QPen(faint(i == 0 ? 0.8 : 0.35), i == 0 ? 1.6 : 1.0));
    painter->drawLine(QPointF(0, 0), ray * outer);
  }
  // As in OPRA the rays have even numbers and the sectors between them odd ones.
  for (int i = 0; i < 2 * m; ++i) {
    const QPointF middle = screen.direction(m_yaw + (i + 0.5) * sector);
    drawHaloText(painter, middle * delta * scale * 1.12, QString::number(2 * i + 1),
                 fieldFont(10, false), theme().fieldLines, shade());
  }
}

void SectorItem::paintStarVars(QPainter* painter, const ScreenPainting& screen) const {
  const double outer = starVarsReach * screen.pixelsPerMetre();
  const double sector = 2 * std::numbers::pi / starVarsGranularity;
  for (int i = 0; i < starVarsGranularity; ++i) {
    const QPointF ray = screen.direction(m_yaw + i * sector);
    QPen pen(faint(i == 0 ? 0.9 : 0.55), i == 0 ? 1.8 : 1.2);
    pen.setDashPattern({5.0, 3.0});
    painter->setPen(pen);
    painter->drawLine(QPointF(0, 0), ray * outer);
    const QPointF middle = screen.direction(m_yaw + (i + 0.5) * sector);
    drawHaloText(painter, middle * outer * 0.92, QString::number(i), fieldFont(11, true),
                 theme().fieldLines, shade());
  }
}

}  // namespace pitchboard::ui
