// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Names beside robots whose number cannot be read in their disc: it is too small to write in, or
// another robot covers it. They never lie on each other or on a robot while there is room. UI
// thread; belongs to the scene.

#include <QGraphicsItem>
#include <QSizeF>
#include <map>
#include <span>
#include <vector>

#include <base/ids.h>

#include "field_style.h"

namespace pitchboard::ui {

/// A robot on the screen, in pixels.
struct NamedRobot {
  RobotId id;
  QPointF at;
  double radius = 0.0;
  QSizeF name;  ///< how large its name is when written
};

/// Where a name is written.
struct PlacedName {
  RobotId id;
  QPointF centre;
  bool apart = false;  ///< so far away that a line has to say whose it is
};

/// Places for the names of those that need one. `before`: the direction that each name had, which
/// is kept where it can be; changed accordingly.
std::vector<PlacedName> placeNames(std::span<const NamedRobot> robots,
                                   std::map<RobotId, int>& before);

class NameLabelsItem : public QGraphicsItem {
 public:
  explicit NameLabelsItem(const FieldStyle* style) : m_style(style) {}

  struct Robot {
    RobotId id;
    QPointF at;           ///< in the scene, m
    double radius = 0.0;  ///< as drawn, m
    QString name;
  };
  void setRobots(std::vector<Robot> robots);
  void styleChanges();

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

  const FieldStyle* m_style;
  std::vector<Robot> m_robots;
  std::vector<Label> m_labels;
  std::map<RobotId, int> m_before;
  QRectF m_bounds;
};

}  // namespace pitchboard::ui
