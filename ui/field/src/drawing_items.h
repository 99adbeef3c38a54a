// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What robots' programs draw on the field (docs/drawings.md): an item for each layer of each robot.
// A layer that counts from its robot goes where the robot goes. UI thread; belongs to the scene.

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <base/robot_key.h>
#include <base/team_color.h>
#include <telemetry/drawings/drawing_store.h>

#include "field_item.h"

namespace pitchboard::link {
struct MatchFrame;
}

namespace pitchboard::ui {

/// One layer of one robot.
class DrawingItem : public FieldItem {
 public:
  using FieldItem::FieldItem;
  /// `origin`: from where its coordinates count.
  void setLayer(std::shared_ptr<const telemetry::DrawingLayer> layer, TeamColor team,
                const Pose& origin);
  void styleChanges() override;
  QRectF boundingRect() const override { return m_bounds; }
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  void paintShape(QPainter* painter, const ScreenPainting& screen,
                  const telemetry::DrawingShape& shape) const;
  QPointF onField(const Point& p) const;
  QColor colourOf(const telemetry::DrawingShape& shape) const;
  QRectF computeBounds() const;

  std::shared_ptr<const telemetry::DrawingLayer> m_layer;
  TeamColor m_team = TeamColor::Blue;
  Pose m_origin;
  QRectF m_bounds;
};

class DrawingItems {
 public:
  /// The items lie at this height of the scene.
  DrawingItems(QGraphicsScene* scene, const FieldStyle* style, double height)
      : m_scene(scene), m_style(style), m_height(height) {}

  void show(const link::MatchFrame* frame, const std::vector<RobotUid>& selection);

 private:
  QGraphicsScene* m_scene;
  const FieldStyle* m_style;
  double m_height;
  std::map<std::pair<RobotKey, std::string>, std::unique_ptr<DrawingItem>> m_items;
};

}  // namespace pitchboard::ui
