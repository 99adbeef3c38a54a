// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What only a match with other eyes on it has: the ball that a team agrees on, and where another
// source sees a robot.

#include <vector>

#include <base/team_color.h>
#include <robotlink/frame/live_values.h>
#include "field_item.h"

namespace pitchboard::ui {

/// For each team a cross in a circle as wide as its robots' opinions, with how many of them agree.
class TeamBallsItem : public FieldItem {
 public:
  using FieldItem::FieldItem;
  void setBalls(std::vector<link::TeamBall> balls);
  /// Where robots are drawn, m: the texts avoid them where they can.
  void setRobots(std::vector<QPointF> robots, double radius);
  QRectF boundingRect() const override;
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  double radius(const link::TeamBall& ball) const;  // metres
  QPointF textPosition(const ScreenPainting& screen, const link::TeamBall& ball, QSizeF plate,
                       double ring) const;

  std::vector<link::TeamBall> m_balls;
  std::vector<QPointF> m_robots;
  double m_robotRadius = 0.0;
};

/// The same robot as another source shows it.
struct OtherPose {
  Pose pose;
  Point here;  ///< where this source shows it
  TeamColor team = TeamColor::Blue;
  QString text;  ///< "12 cm 4°"
  bool operator==(const OtherPose&) const = default;
};

/// A dotted ring with a heading at the other pose, joined to the robot, with the difference.
class OtherPoseItem : public FieldItem {
 public:
  using FieldItem::FieldItem;
  void setOther(const OtherPose& other);
  const OtherPose& other() const { return m_other; }
  QRectF boundingRect() const override;
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  OtherPose m_other;
};

}  // namespace pitchboard::ui
