// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The ball where it really is.

#include <QGraphicsItem>

#include "field_style.h"

namespace pitchboard::ui {

class BallItem : public QGraphicsItem {
 public:
  explicit BallItem(const FieldStyle* style) : m_style(style) {}

  void setBall(const Point& position) { setPos(toScene(position)); }
  void setSelected(bool selected);
  void styleChanges() { prepareGeometryChange(); }

  QRectF boundingRect() const override;
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  const FieldStyle* m_style;
  bool m_selected = false;
};

}  // namespace pitchboard::ui
