// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What tools draw over the field: the ruler with its reading, the rubber band, and the robot that
// is about to be added.

#include <optional>

#include "field_item.h"

namespace pitchboard::ui {

/// Distance in metres and direction in degrees, counter-clockwise from +x: "2.34 m   −31.0°".
QString rulerText(const QPointF& from, const QPointF& to);

class RulerItem : public FieldItem {
 public:
  using FieldItem::FieldItem;
  void setLine(const QPointF& from, const QPointF& to);
  /// An arrow with the speed of a kick instead, m/s.
  void setArrow(const QPointF& from, const QPointF& to, double speed);
  QPointF from() const { return m_from; }
  QPointF to() const { return m_to; }
  QRectF boundingRect() const override;
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  QPointF m_from, m_to;
  std::optional<double> m_speed;  // none: it measures
};

class RubberBandItem : public FieldItem {
 public:
  using FieldItem::FieldItem;
  void setBand(const QRectF& metres);
  QRectF boundingRect() const override;
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  QRectF m_band;
};

}  // namespace pitchboard::ui
