// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What may come: a heat map of the ball, and actions as arrows with their values. Used for the
// panel Explore and for the advisors of robots.

#include <QColor>
#include <QImage>
#include <memory>
#include <optional>
#include <vector>

#include <robotlink/frame/advice_view.h>

#include "field_item.h"

namespace pitchboard::ui {

/// Shares of cells as a smooth picture over the field; the strongest cell is the most opaque.
class HeatItem : public FieldItem {
 public:
  using FieldItem::FieldItem;
  /// Null: nothing is drawn.
  void setHeat(std::shared_ptr<const link::BallHeat> heat, const QColor& color);
  QRectF boundingRect() const override;
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  std::shared_ptr<const link::BallHeat> m_heat;
  QColor m_color;
  QImage m_picture;
};

/// An action as it is drawn. Metres.
struct DrawnAction {
  QPointF from;
  std::optional<QPointF> to;  ///< nothing: a ring at `from`
  QString text;               ///< at the tip
  QColor color;
  double width = 3.0;  ///< pixels
  double opacity = 1.0;
  bool dashed = false;
  bool operator==(const DrawnAction&) const = default;
};

class ActionArrowsItem : public FieldItem {
 public:
  using FieldItem::FieldItem;
  /// The last one is drawn on top.
  void setActions(std::vector<DrawnAction> actions);
  const std::vector<DrawnAction>& actions() const { return m_actions; }
  QRectF boundingRect() const override;
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  std::vector<DrawnAction> m_actions;
};

}  // namespace pitchboard::ui
