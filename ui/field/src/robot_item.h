// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A robot's body: disc, nose in the direction of its heading, number, selection ring and handle.

#include <QString>
#include <optional>

#include <base/robot_key.h>
#include <base/team_color.h>

#include "field_item.h"

namespace pitchboard::ui {

/// All that a body shows.
struct RobotLook {
  Pose pose;
  TeamColor team = TeamColor::Blue;
  int number = 1;
  QString name;
  double radius = 0.0;  ///< metres; 0 = the field's robot radius
  bool fallen = false;
  bool selected = false;
  bool followed = false;
  QString tag;           ///< beside the robot: "fallen", "penalised", "timeout 37 s"
  double opacity = 1.0;  ///< 0.45 for a robot that has timed out
  bool operator==(const RobotLook&) const = default;
};

class RobotItem : public FieldItem {
 public:
  RobotItem(const FieldStyle* style, RobotUid id);

  RobotUid id() const { return m_id; }
  const RobotLook& look() const { return m_look; }
  void setLook(const RobotLook& look);
  /// Where its tag is painted, in pixels from its centre; null: it is not painted.
  void setTagPosition(const std::optional<QPointF>& place);

  /// Where the turning handle is, in metres of the scene.
  static QPointF handlePosition(const FieldStyle& style, const Pose& pose, double radius);
  static double handleRadius(const FieldStyle& style);  ///< metres

  QRectF boundingRect() const override;
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  double bodyRadius() const { return m_style->drawRadius(m_look.radius); }  // metres
  void paintSelection(QPainter* painter, const ScreenPainting& screen, double radius) const;
  void paintBody(QPainter* painter, const ScreenPainting& screen, double radius) const;

  RobotUid m_id;
  RobotLook m_look;
  std::optional<QPointF> m_tagPosition;  // pixels
};

}  // namespace pitchboard::ui
