// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a robot's camera can see: a sector round the direction of the head.

#include <QGraphicsItem>
#include <QPainterPath>

#include "field_style.h"

namespace pitchboard::ui {

class ViewWedgeItem : public QGraphicsItem {
 public:
  /// Simulated vision (SYSTEM.md section 4).
  static constexpr double openingDegrees = 70.0;
  static constexpr double range = 3.0;  ///< metres

  explicit ViewWedgeItem(const FieldStyle* style);

  void setHead(const Point& position, double headYaw);
  void styleChanges() { prepareGeometryChange(); }

  QRectF boundingRect() const override;
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  const FieldStyle* m_style;
  QPainterPath m_path;    // of the present direction, relative to the robot
  double m_yaw = 0.0;
};

}  // namespace pitchboard::ui
