// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a robot believes: circle of its uncertainty, ghost at the believed pose, and the ball that
// it perceives, joined to the ghost (or to the robot when it does not localize).

#include <optional>

#include <base/team_color.h>

#include "field_item.h"

namespace pitchboard::link {
struct RobotFrame;
}
namespace pitchboard::sim {
struct FieldSpec;
}

namespace pitchboard::ui {

struct BeliefLook {
  TeamColor team = TeamColor::Blue;
  std::optional<Pose> believed;  ///< while localization works
  double sigma = 0.0;            ///< metres, of the particles
  std::optional<Point> ball;     ///< perceived, in the field's frame
  bool ghost = true;             ///< false: the robot itself is drawn at the believed pose
  int number = 0;                ///< of the robot
  std::optional<Point> stands;   ///< where it really is, when the ghost is far from it
  Point origin;                  ///< where the line to the ball begins
  double opacity = 1.0;
  bool operator==(const BeliefLook&) const = default;
};

/// What the robot believes and perceives. One that is received is drawn where it believes to be: it
/// has no ghost.
BeliefLook beliefOf(const link::RobotFrame& robot, const sim::FieldSpec& field);

class BeliefItem : public FieldItem {
 public:
  /// From this distance on a line joins a ghost to its robot, m.
  static constexpr double apart = 0.5;
  /// The published telemetry draws no smaller circle (system.md section 7).
  static constexpr double minRadius = 0.15;

  using FieldItem::FieldItem;

  void setLook(const BeliefLook& look);
  const BeliefLook& look() const { return m_look; }
  void styleChanges() override;

  QRectF boundingRect() const override { return m_bounds; }
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  QRectF computeBounds() const;
  double ghostRadius() const;  // m
  void paintDisc(QPainter* painter, const ScreenPainting& screen) const;
  void paintGhost(QPainter* painter, const ScreenPainting& screen) const;
  void paintPerceivedBall(QPainter* painter) const;
  void paintBallInside(QPainter* painter) const;

  BeliefLook m_look;
  QRectF m_bounds;
};

}  // namespace pitchboard::ui
