// SPDX-License-Identifier: GPL-3.0-or-later
#include "view_wedge_item.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

constexpr int arcSteps = 28;

QPolygonF sector(const QPointF& at, double yaw, double opening, double range) {
  QPolygonF corners{at};
  for (int i = 0; i <= arcSteps; ++i) {
    const double angle = yaw + opening * (static_cast<double>(i) / arcSteps - 0.5);
    corners << at + range * QPointF(std::cos(angle), std::sin(angle));
  }
  return corners;
}

/// The part of a convex polygon where `inside` is not negative; `inside` is linear.
template <class Inside>
QPolygonF clipped(const QPolygonF& polygon, Inside inside) {
  QPolygonF kept;
  for (qsizetype i = 0; i < polygon.size(); ++i) {
    const QPointF& a = polygon[i];
    const QPointF& b = polygon[(i + 1) % polygon.size()];
    const double atA = inside(a), atB = inside(b);
    if (atA >= 0) kept << a;
    if ((atA < 0) != (atB < 0)) kept << a + (b - a) * (atA / (atA - atB));
  }
  return kept;
}

}  // namespace

void ViewWedgeItem::setCamera(double opening, double range) {
  constexpr double halfRound = 3.14;  // the outline is clipped as a convex one
  opening = std::min(opening, halfRound);
  m_otherCamera = m_otherCamera || opening != m_opening || range != m_range;
  m_opening = opening;
  m_range = range;
}

void ViewWedgeItem::setShare(double share) {
  if (std::exchange(m_share, share) != share) update();
}

void ViewWedgeItem::setHead(const Point& position, double headYaw) {
  if (!m_otherCamera && position == m_position && headYaw == m_yaw &&
      isVisible() == !m_outline.isEmpty())
    return;
  m_position = position;
  m_yaw = headYaw;
  m_otherCamera = false;
  styleChanges();
}

void ViewWedgeItem::styleChanges() {
  prepareGeometryChange();
  if (!isVisible()) {
    m_outline.clear();
    return;
  }
  const QRectF area = m_style->playingArea();
  const double x = area.right(), y = area.bottom();
  m_outline = sector(toScene(m_position), m_yaw, m_opening, m_range);
  m_outline = clipped(m_outline, [x](const QPointF& p) { return x - p.x(); });
  m_outline = clipped(m_outline, [x](const QPointF& p) { return x + p.x(); });
  m_outline = clipped(m_outline, [y](const QPointF& p) { return y - p.y(); });
  m_outline = clipped(m_outline, [y](const QPointF& p) { return y + p.y(); });
}

QRectF ViewWedgeItem::boundingRect() const {
  const double margin = m_style->metres(1.0);
  return m_outline.boundingRect().adjusted(-margin, -margin, margin, margin);
}

void ViewWedgeItem::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) {
  if (m_outline.size() < 3) return;
  QColor fill = isDarkTheme() ? theme().fieldLines : QColor(Qt::white);
  // A single one of many is still to be seen.
  const double bright = isDarkTheme() ? 0.13 : 0.22;
  fill.setAlphaF(static_cast<float>(std::max(0.03, bright * m_share)));
  painter->setPen(Qt::NoPen);
  painter->setBrush(fill);
  // The edge drawn over it is smooth; a fill without smooth edges has few spans and is fast.
  painter->setRenderHint(QPainter::Antialiasing, false);
  painter->drawConvexPolygon(m_outline);
  painter->setRenderHint(QPainter::Antialiasing, true);
  QPen pen(onGrass(theme().fieldLines, 0.52), 1.0);
  pen.setCosmetic(true);
  pen.setCapStyle(Qt::FlatCap);
  painter->setPen(pen);
  painter->setBrush(Qt::NoBrush);
  painter->drawPolygon(m_outline);
}

}  // namespace pitchboard::ui
