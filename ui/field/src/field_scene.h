// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// All that stands on the field: one group of items per robot, the ball, and what tools draw over
// them. A frame moves items; nothing is built again unless robots come or go.

#include <QGraphicsScene>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include <ui/sources/ball_heat.h>
#include <ui/sources/frame_source.h>
#include <ui/sources/match_edits.h>

#include "field_style.h"

namespace pitchboard::ui {

class ActionArrowsItem;
class BallItem;
class BeliefItem;
class ComparedItem;
class DrawingItems;
class HeatItem;
class NameLabelsItem;
class OtherPoseItem;
class RobotItem;
class RubberBandItem;
class RulerItem;
class SectorItem;
class TeamBallsItem;
class TrailItem;
class ViewWedgeItem;

/// What is under a point of the field.
struct FieldHit {
  enum class Kind { Nothing, Robot, Handle, Ball };
  Kind kind = Kind::Nothing;
  RobotUid robot;
};

class FieldScene : public QGraphicsScene {
  Q_OBJECT
 public:
  explicit FieldScene(QObject* parent = nullptr);
  ~FieldScene() override;

  const FieldStyle& style() const { return m_style; }
  /// Changes how things are drawn; items adapt what they cover.
  template <class Change>
  void changeStyle(Change change) {
    change(m_style);
    styleChanged();
  }

  void showFrame(const FramePtr& frame);
  /// Before the first frame says so.
  void setField(const sim::FieldSpec& field);
  const FramePtr& frame() const { return m_frame; }
  /// Rows of what is shown, from which trails are made; nothing: trails grow with the frames.
  using Rows = std::function<std::shared_ptr<const telemetry::SeriesStore>()>;
  void setRows(Rows rows) { m_rows = std::move(rows); }
  /// More rows are there: the same moment may look different.
  void rowsCame() {
    if (m_frame) showFrame(m_frame);
  }
  /// Another source's view of the same robots, drawn beside this one's; null: none.
  void showOther(const FramePtr& frame);
  /// A moment of another session, drawn over this one; null: none. `number`: of the session, 0 for
  /// an abandoned future.
  void showCompared(int number, const FramePtr& frame);
  /// Draws robots and ball where the user holds them, faint, beside what the match makes of them;
  /// neither: nothing is held.
  void showHeld(const std::vector<RobotPlacement>& robots, std::optional<Point> ball = {});
  /// What may follow a moment; null: nothing.
  void showHeat(const BallHeatPtr& heat);

  const std::vector<RobotUid>& selection() const { return m_selection; }
  /// Returns the selected robots of a simulated match, for orders.
  std::vector<RobotId> selectedSlots() const {
    return m_frame ? m_frame->slotsOf(m_selection) : std::vector<RobotId>();
  }
  /// Robots that are not there are left out.
  void select(const std::vector<RobotUid>& ids);
  void selectAll();
  void toggle(RobotUid id);

  FieldHit hit(const QPointF& metres) const;
  std::vector<RobotUid> robotsIn(const QRectF& metres) const;
  std::optional<Pose> pose(RobotUid id) const;
  /// Of the body, metres.
  double radius(RobotUid id) const;
  Point ball() const;

  void setTrailShown(RobotUid id, bool shown);
  bool isTrailShown(RobotUid id) const { return !m_hiddenTrails.contains(id); }
  void setFollowed(std::optional<RobotUid> id);
  std::optional<RobotUid> followed() const { return m_followed; }

  RulerItem* ruler() const { return m_ruler; }
  RubberBandItem* rubberBand() const { return m_band; }

 signals:
  void selectionChangedTo(const std::vector<pitchboard::RobotUid>& ids);
  void followedChanged(std::optional<pitchboard::RobotUid> id);

 private:
  struct Robot;
  void styleChanged();
  void matchRobots();
  void showRobot(const link::RobotFrame& now);
  void showWedges();
  void showTrail(Robot& robot, const link::RobotFrame& now);
  void showOtherPose(Robot& robot, const link::RobotFrame& now);
  void showNames();
  void showComparedNames();
  void showComparedNamesSoon();
  void showDebugOverlay();
  void showSelected();
  void setSelection(std::vector<RobotUid> ids);

  FieldStyle m_style;
  Rows m_rows;
  FramePtr m_frame;
  FramePtr m_other;
  std::map<RobotUid, std::unique_ptr<Robot>> m_robots;
  std::vector<RobotUid> m_selection;
  std::set<RobotUid> m_hiddenTrails;
  std::optional<RobotUid> m_followed;
  BallItem* m_ball;
  BallItem* m_heldBall;
  std::vector<std::unique_ptr<RobotItem>> m_held;
  TeamBallsItem* m_teamBalls;
  std::unique_ptr<DrawingItems> m_drawings;
  std::map<int, ComparedItem*> m_compared;  // by the session's number
  std::map<RobotUid, int> m_comparedNames;  // where they were written before (DirectionsBefore)
  bool m_comparedMoved = false;             // since names were placed
  HeatItem* m_heat;
  SectorItem* m_eopra;
  SectorItem* m_starVars;
  NameLabelsItem* m_names;
  RulerItem* m_ruler;
  RubberBandItem* m_band;
};

}  // namespace pitchboard::ui
