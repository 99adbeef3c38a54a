// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The ball where it really is.

#include "field_item.h"

namespace pitchboard::ui {

class BallItem : public FieldItem {
 public:
  using FieldItem::FieldItem;

  void setBall(const Point& position) { setPos(toScene(position)); }
  void setSelected(bool selected);

  QRectF boundingRect() const override;
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  bool m_selected = false;
};

}  // namespace pitchboard::ui
