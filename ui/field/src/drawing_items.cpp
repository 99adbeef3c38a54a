// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawing_items.h"

#include <QFontMetricsF>
#include <QGraphicsScene>
#include <QPolygonF>
#include <algorithm>
#include <cmath>
#include <optional>

#include <robotlink/frame/drawing_origin.h>
#include <robotlink/frame/match_frame.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

using telemetry::DrawingShape;
using telemetry::ShapeKind;

constexpr double headLength_px = 11.0, headWidth_px = 4.5, pointRadius_px = 3.0;
constexpr int textSize_px = 12;
constexpr float fillAlpha = 0.35F;

const QFont& textFont() {
  return fieldFont(textSize_px, true);
}

QString textOf(const DrawingShape& shape) {
  return QString::fromStdString(shape.text);
}

}  // namespace

void DrawingItem::setLayer(std::shared_ptr<const telemetry::DrawingLayer> layer, TeamColor team,
                           const Pose& origin) {
  if (layer == m_layer && team == m_team && origin == m_origin) return;
  prepareGeometryChange();
  m_layer = std::move(layer);
  m_team = team;
  m_origin = origin;
  m_bounds = computeBounds();
  update();
}

void DrawingItem::styleChanges() {
  prepareGeometryChange();
  m_bounds = computeBounds();
}

QPointF DrawingItem::onField(const Point& p) const {
  const double c = std::cos(m_origin.yaw), s = std::sin(m_origin.yaw);
  return {m_origin.position.x + c * p.x - s * p.y, m_origin.position.y + s * p.x + c * p.y};
}

QColor DrawingItem::colourOf(const DrawingShape& shape) const {
  if (shape.colour) return QColor::fromRgba(*shape.colour);
  const QColor team = theme().team(m_team);
  return isDarkTheme() ? team.lighter(125) : team;
}

QRectF DrawingItem::computeBounds() const {
  QRectF all;
  if (!m_layer) return all;
  for (const DrawingShape& shape : m_layer->shapes) {
    double acrossX = m_style->metres(shape.width + headLength_px + 2.0), acrossY = acrossX;
    if (shape.kind == ShapeKind::Circle || shape.kind == ShapeKind::Disc) {
      acrossX = acrossY = shape.radius + m_style->metres(shape.width + 2.0);
    } else if (shape.kind == ShapeKind::Text) {
      const QFontMetricsF metrics(textFont());
      acrossX = m_style->metres(metrics.horizontalAdvance(textOf(shape)) / 2 + 6.0);
      acrossY = m_style->metres(metrics.height() / 2 + 6.0);
    }
    for (const Point& point : shape.points) {
      const QPointF at = onField(point);
      all |= QRectF(at.x() - acrossX, at.y() - acrossY, 2 * acrossX, 2 * acrossY);
    }
  }
  return all;
}

void DrawingItem::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) {
  if (!m_layer) return;
  const ScreenPainting screen(painter, QPointF(0, 0));
  for (const DrawingShape& shape : m_layer->shapes) paintShape(painter, screen, shape);
}

void DrawingItem::paintShape(QPainter* painter, const ScreenPainting& screen,
                             const DrawingShape& shape) const {
  const QColor colour = colourOf(shape);
  QColor fill = colour;
  fill.setAlphaF(colour.alphaF() * fillAlpha);
  QPolygonF points;
  points.reserve(static_cast<qsizetype>(shape.points.size()));
  for (const Point& point : shape.points) points << screen.pixels(onField(point));
  const QPen pen(colour, shape.width, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin);
  painter->setPen(pen);
  painter->setBrush(Qt::NoBrush);
  const double radius = shape.radius * screen.pixelsPerMetre();
  switch (shape.kind) {
    case ShapeKind::Line:
      painter->drawPolyline(points);
      break;
    case ShapeKind::Arrow: {
      const QPointF tip = points.last(), offset = tip - points[points.size() - 2];
      const double length = std::hypot(offset.x(), offset.y());
      if (length > 1.0) {
        const QPointF ahead = offset / length, side(-ahead.y(), ahead.x());
        const double head = std::min(headLength_px + shape.width, length);
        const double wide = (headWidth_px + shape.width / 2) * head / (headLength_px + shape.width);
        points.last() = tip - ahead * head * 0.8;
        painter->drawPolyline(points);
        painter->setPen(Qt::NoPen);
        painter->setBrush(colour);
        const QPointF tail = tip - ahead * head;
        const QPointF triangle[] = {tip, tail + side * wide, tail - side * wide};
        painter->drawPolygon(triangle, 3);
      } else {
        painter->drawPolyline(points);
      }
      break;
    }
    case ShapeKind::Disc:
      painter->setBrush(fill);
      [[fallthrough]];
    case ShapeKind::Circle:
      painter->drawEllipse(points.first(), radius, radius);
      break;
    case ShapeKind::Area:
      painter->setBrush(fill);
      [[fallthrough]];
    case ShapeKind::Polygon:
      painter->drawPolygon(points);
      break;
    case ShapeKind::Point:
      painter->setPen(Qt::NoPen);
      painter->setBrush(colour);
      painter->drawEllipse(points.first(), std::max(pointRadius_px, shape.width),
                           std::max(pointRadius_px, shape.width));
      break;
    case ShapeKind::Text: {
      const bool dark = qGray(colour.rgb()) < 90;
      drawHaloText(painter, points.first(), textOf(shape), textFont(), colour,
                   dark ? QColor(Qt::white) : theme().fieldBorder.darker(190));
      break;
    }
  }
}

void DrawingItems::show(const link::MatchFrame* frame, const std::vector<RobotUid>& selection) {
  decltype(m_items) before;
  before.swap(m_items);
  if (frame == nullptr || !m_style->shows(FieldLayer::Drawings)) return;
  for (const telemetry::RobotDrawings& drawn : frame->drawings) {
    const link::RobotFrame* robot = frame->robot(drawn.robot);
    if (m_style->drawings.onlySelected &&
        (robot == nullptr || std::ranges::find(selection, robot->uid) == selection.end())) {
      continue;
    }
    for (const auto& layer : drawn.layers) {
      const auto origin = link::drawingOrigin(layer->frame, robot);
      if (!origin || !m_style->drawings.shows(drawn.robot, layer->name)) continue;
      const std::pair key(drawn.robot, layer->name);
      auto kept = before.extract(key);
      if (kept.empty()) {
        auto& item = m_items[key];
        item = std::make_unique<DrawingItem>(m_style);
        item->setZValue(m_height);
        m_scene->addItem(item.get());
      } else {
        m_items.insert(std::move(kept));
      }
      m_items[key]->setLayer(layer, robot ? robot->identity.team : TeamColor::Blue, *origin);
    }
  }
}

}  // namespace pitchboard::ui
