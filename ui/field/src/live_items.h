// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What only a match with other eyes on it has: the ball that a team agrees on, and where another
// source sees a robot.

#include <QGraphicsItem>
#include <vector>

#include <base/ids.h>
#include <robotlink/frame/live_values.h>
#include "field_style.h"

namespace pitchboard::ui {

/// A cross in a circle as wide as the robots' opinions, with how many of them agree.
class TeamBallItem : public QGraphicsItem {
 public:
  explicit TeamBallItem(const FieldStyle* style) : m_style(style) {}
  void setBall(const std::optional<link::TeamBall>& ball);
  /// Where robots are drawn, m: the words keep off them where they can.
  void setRobots(std::vector<QPointF> robots, double radius);
  void styleChanges() { prepareGeometryChange(); }
  QRectF boundingRect() const override;
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  QString words() const;
  double radius() const;  // metres
  QPointF wordsAt(const ScreenPainting& screen, double ring) const;

  const FieldStyle* m_style;
  link::TeamBall m_ball;
  QSizeF m_plate;  // of its words, px
  std::vector<QPointF> m_robots;
  double m_robotRadius = 0.0;
};

/// The same robot as another source shows it.
struct OtherPose {
  Pose pose;
  Point here;  ///< where this source shows it
  TeamColor team = TeamColor::Blue;
  QString words;  ///< "12 cm 4°"
  bool operator==(const OtherPose&) const = default;
};

/// A dotted ring with a heading at the other pose, joined to the robot, with the difference.
class OtherPoseItem : public QGraphicsItem {
 public:
  explicit OtherPoseItem(const FieldStyle* style) : m_style(style) {}
  void setOther(const OtherPose& other);
  const OtherPose& other() const { return m_other; }
  void styleChanges() { prepareGeometryChange(); }
  QRectF boundingRect() const override;
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  const FieldStyle* m_style;
  OtherPose m_other;
};

}  // namespace pitchboard::ui
