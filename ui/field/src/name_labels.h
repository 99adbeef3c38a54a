// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Texts beside robots: tags with their state ("timeout 37 s"), and names of those whose number
// cannot be read in their disc, because it is too small or another robot covers it. They never
// overlap each other or a robot while there is room. UI thread; belongs to the scene.

#include <QSizeF>
#include <map>
#include <span>
#include <vector>

#include <base/robot_key.h>

#include "field_item.h"

namespace pitchboard::ui {

/// A robot on the screen, in pixels.
struct NamedRobot {
  RobotUid id;
  QPointF at;
  double radius = 0.0;
  QSizeF name;           ///< how large its name is when written
  QSizeF tag = {};       ///< size of the plate of its tag; empty: no tag
  QString tagText = {};  ///< robots side by side with the same text share a plate
};

/// Where a name or a tag is written.
struct PlacedName {
  RobotUid id;
  QPointF centre;
  bool apart = false;  ///< so far away that a line has to say whose it is
};

/// The direction that each of them had, which is kept where it can be.
using DirectionsBefore = std::map<RobotUid, int>;

/// Returns places for the tags, below their robots where there is room, and inside `area`. Of
/// robots that share a tag only the first has a place: in the middle of them.
std::vector<PlacedName> placeTags(std::span<const NamedRobot> robots, const QRectF& area,
                                  DirectionsBefore& before);
/// Returns places for the names of those that need one, inside `area` (null: everywhere); `taken`
/// is not written on.
std::vector<PlacedName> placeNames(std::span<const NamedRobot> robots, const QRectF& area,
                                   DirectionsBefore& before, std::vector<QRectF> taken = {});

/// Returns a place for each name, below its robot where no name before it is, otherwise round it.
/// Unlike those above, names may lie on discs: on hatched ones they can be read, and they stand
/// still while robots pass each other.
std::vector<PlacedName> placeNamesBelow(std::span<const NamedRobot> robots,
                                        DirectionsBefore& before);

class NameLabelsItem : public FieldItem {
 public:
  using FieldItem::FieldItem;

  struct Robot {
    RobotUid id;
    QPointF at;           ///< in the scene, m
    double radius = 0.0;  ///< as drawn, m
    QString name;         ///< empty: not to be written
    QString tag;
  };
  /// Also places the tags, which the robots paint themselves.
  void setRobots(std::vector<Robot> robots);
  /// In pixels from the robot, of those that have a tag.
  const std::map<RobotUid, QPointF>& tags() const { return m_tags; }

  QRectF boundingRect() const override { return m_bounds; }
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  struct Label {
    QPointF robot;  // in the scene, m
    double radius = 0.0;
    QPointF offset;  // pixels on the screen
    bool apart = false;
    QString name;
  };
  void place();

  std::vector<Robot> m_robots;
  std::vector<Label> m_labels;
  std::map<RobotUid, QPointF> m_tags;
  DirectionsBefore m_before, m_tagsBefore;
  QRectF m_bounds;
};

}  // namespace pitchboard::ui
