// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a robot's camera can see: a sector round the direction of the head, as far as the playing
// area with its border goes.

#include <QPolygonF>

#include "field_item.h"

namespace pitchboard::ui {

class ViewWedgeItem : public FieldItem {
 public:
  using FieldItem::FieldItem;

  /// What this kind of robot sees: rad in all, metres. Shows with the next setHead().
  void setCamera(double opening, double range);
  void setHead(const Point& position, double headYaw);
  /// How much of the usual brightness its ground has, 0 to 1.
  void setShare(double share);
  void styleChanges() override;

  QRectF boundingRect() const override;
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  Point m_position;
  double m_yaw = 0.0;
  double m_opening = 0.0, m_range = 0.0;
  double m_share = 1.0;
  bool m_otherCamera = false;
  QPolygonF m_outline;
};

}  // namespace pitchboard::ui
