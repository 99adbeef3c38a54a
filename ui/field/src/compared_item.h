// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Robots and ball of another session at the moment that is compared: hatched discs with a mark
// behind their names, so that they are told from robots, from what robots believe and from another
// source's dotted rings without colour.

#include <map>
#include <vector>

#include <ui/sources/frame_source.h>

#include "field_item.h"
#include "name_labels.h"

namespace pitchboard::ui {

class ComparedItem : public FieldItem {
 public:
  /// `number`: of the session (session_mark.h), which gives colour and mark; 0: the colours are
  /// those of the teams.
  ComparedItem(const FieldStyle* style, int number) : FieldItem(style), m_number(number) {}
  /// Not null.
  void setFrame(const FramePtr& frame);
  int robots() const { return static_cast<int>(m_robots.size()); }
  /// Appends its robots as they are on the screen, with ids that no other session has.
  void addNamed(std::vector<NamedRobot>& all) const;
  /// Writes the names of those robots there.
  void placeNames(const std::map<RobotUid, QPointF>& centres);
  /// Returns where names are written, in pixels of the screen; for tests.
  std::vector<QRectF> nameRects() const;
  QRectF boundingRect() const override;
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  struct Robot {
    Pose pose;
    TeamColor team = TeamColor::Blue;
    QString name;     // with the mark of the session
    QSizeF nameSize;  // px
    bool fallen = false;
    QPointF nameOffset = {};  // px, from the robot
  };
  void paintRobot(QPainter* painter, const Robot& robot) const;
  QPointF onScreen(const Robot& robot) const;
  RobotUid idOf(std::size_t index) const;

  int m_number;
  std::vector<Robot> m_robots;
  std::optional<Point> m_ball;
};

}  // namespace pitchboard::ui
