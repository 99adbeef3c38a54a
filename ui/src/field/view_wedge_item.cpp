// SPDX-License-Identifier: GPL-3.0-or-later
#include "view_wedge_item.h"

#include <base/angles.h>
#include <ui/theme.h>

namespace pitchboard::ui {
namespace {

QPainterPath sector(double yaw) {
  // QPainterPath counts angles with y down; the scene has y up.
  const double start = -degreesFromRadians(yaw) - ViewWedgeItem::openingDegrees / 2;
  QPainterPath path;
  path.arcTo(QRectF(-ViewWedgeItem::range, -ViewWedgeItem::range, 2 * ViewWedgeItem::range,
                    2 * ViewWedgeItem::range),
             start, ViewWedgeItem::openingDegrees);
  path.closeSubpath();
  return path;
}

}  // namespace

ViewWedgeItem::ViewWedgeItem(const FieldStyle* style) : m_style(style), m_path(sector(0.0)) {}

void ViewWedgeItem::setHead(const Point& position, double headYaw) {
  setPos(toScene(position));
  if (headYaw == m_yaw) return;
  prepareGeometryChange();
  m_yaw = headYaw;
  m_path = sector(headYaw);
}

QRectF ViewWedgeItem::boundingRect() const {
  const double margin = m_style->metres(1.0);
  return m_path.boundingRect().adjusted(-margin, -margin, margin, margin);
}

void ViewWedgeItem::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) {
  QColor fill = isDarkTheme() ? theme().fieldLines : QColor(Qt::white);
  fill.setAlphaF(isDarkTheme() ? 0.13F : 0.22F);
  QColor edge = theme().fieldLines;
  edge.setAlphaF(0.45F);
  QPen pen(edge, 1.0);
  pen.setCosmetic(true);
  painter->setPen(pen);
  painter->setBrush(fill);
  painter->drawPath(m_path);
}

}  // namespace pitchboard::ui
