// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where the ball may be, as the panel Explore finds it.

#include <QColor>
#include <QImage>

#include <ui/sources/ball_heat.h>

#include "field_item.h"

namespace pitchboard::ui {

/// Shares of cells as a smooth picture over the field; the strongest cell is the most opaque.
class HeatItem : public FieldItem {
 public:
  using FieldItem::FieldItem;
  /// Null: nothing is drawn.
  void setHeat(BallHeatPtr heat, const QColor& color);
  const BallHeatPtr& heat() const { return m_heat; }
  QRectF boundingRect() const override;
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  BallHeatPtr m_heat;
  QColor m_color;
  QImage m_picture;
};

}  // namespace pitchboard::ui
