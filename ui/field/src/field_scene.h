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

#include <ui/sources/forecast.h>
#include <ui/sources/frame_source.h>

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
  RobotKey robot;
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
  /// A moment of another session, drawn over this one; null: none.
  void showCompared(const FramePtr& frame);
  /// What may follow a moment; null: nothing.
  void showForecast(const ForecastPtr& forecast);

  const std::vector<RobotKey>& selection() const { return m_selection; }
  /// Those of the selection in a simulated match, for orders.
  std::vector<RobotId> selectedSlots() const {
    return m_frame ? m_frame->slotsOf(m_selection) : std::vector<RobotId>();
  }
  /// Robots that are not there are left out.
  void select(const std::vector<RobotKey>& ids);
  void selectAll();
  void toggle(RobotKey id);

  FieldHit hit(const QPointF& metres) const;
  std::vector<RobotKey> robotsIn(const QRectF& metres) const;
  std::optional<Pose> pose(RobotKey id) const;
  /// Of the body, metres.
  double radius(RobotKey id) const;
  Point ball() const;

  void setTrailShown(RobotKey id, bool shown);
  bool isTrailShown(RobotKey id) const { return !m_hiddenTrails.contains(id); }
  void setFollowed(std::optional<RobotKey> id);
  void rename(const std::vector<Renaming>& renamings);
  std::optional<RobotKey> followed() const { return m_followed; }

  RulerItem* ruler() const { return m_ruler; }
  RubberBandItem* rubberBand() const { return m_band; }

 signals:
  void selectionChangedTo(const std::vector<pitchboard::RobotKey>& ids);
  void followedChanged(std::optional<pitchboard::RobotKey> id);

 private:
  struct Robot;
  void styleChanged();
  void matchRobots();
  void showRobot(const link::RobotFrame& now);
  void showTrail(Robot& robot, const link::RobotFrame& now);
  void showOtherPose(Robot& robot, const link::RobotFrame& now);
  void showNames();
  void showDebugOverlay();
  void showForecastItems();
  void showSelected();
  void setSelection(std::vector<RobotKey> ids);

  FieldStyle m_style;
  Rows m_rows;
  FramePtr m_frame;
  FramePtr m_other;
  std::map<RobotKey, std::unique_ptr<Robot>> m_robots;
  std::vector<RobotKey> m_selection;
  std::set<RobotKey> m_hiddenTrails;
  std::optional<RobotKey> m_followed;
  BallItem* m_ball;
  TeamBallsItem* m_teamBalls;
  std::unique_ptr<DrawingItems> m_drawings;
  ComparedItem* m_compared;
  HeatItem* m_heat;
  ActionArrowsItem* m_actions;
  ForecastPtr m_forecast;
  SectorItem* m_eopra;
  SectorItem* m_starVars;
  NameLabelsItem* m_names;
  RulerItem* m_ruler;
  RubberBandItem* m_band;
};

}  // namespace pitchboard::ui
