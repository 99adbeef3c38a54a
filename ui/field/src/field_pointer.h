// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the left mouse button does on the field: drag robots and ball, turn robots, select, measure,
// add. Positions in metres of the scene. While something is held, only the scene shows it at the
// cursor; the match is told when it is released, by one edit.

#include <QObject>
#include <QPointF>
#include <optional>
#include <vector>

#include <ui/sources/match_edits.h>

#include "field_scene.h"

namespace pitchboard::ui {

enum class FieldTool { Select, Ruler, Add };

class FieldPointer : public QObject {
  Q_OBJECT
 public:
  FieldPointer(FieldScene* scene, MatchController* controller, QObject* parent);

  void setTool(FieldTool tool);
  FieldTool tool() const { return m_tool; }
  /// Of the robots that the add tool puts down.
  void setTeam(TeamColor team) { m_team = team; }
  Qt::CursorShape shape(const QPointF& at) const;

  void press(const QPointF& at, Qt::KeyboardModifiers modifiers);
  void move(const QPointF& at, Qt::KeyboardModifiers modifiers);
  void release(const QPointF& at, Qt::KeyboardModifiers modifiers);
  void doubleClick(const QPointF& at);
  /// The wheel over one of the selected robots turns them; false when there is none.
  bool turnAt(const QPointF& at, double notches);
  /// Gives up what is being dragged; says whether anything was.
  bool cancel();
  /// Moves the selected robots by so much.
  void nudge(const QPointF& metres);

 signals:
  void toolChanged(pitchboard::ui::FieldTool tool);
  void poseRequested(pitchboard::RobotUid id);
  void ballRequested();

 private:
  enum class Drag { None, Robots, Turn, Ball, Kick, Band, Ruler };
  void beginRobots(RobotUid hit);
  void beginTurn(RobotUid hit);
  void dragRobots();
  void dragTurn();
  /// How far these robots can go towards `way` together: the first that reaches a wall holds all.
  QPointF together(const std::vector<RobotPlacement>& placements, const QPointF& offset) const;
  /// Of the ball that is kicked along the arrow that is being drawn.
  Velocity kick() const;
  void showHeld();
  void finish();
  /// Moves that the next frame will show; further ones before it start from there.
  void nudgeTo(const std::vector<RobotPlacement>& placements);
  std::vector<RobotPlacement> standing(const std::vector<RobotUid>& ids) const;
  bool canEdit() const;

  FieldScene* m_scene;
  MatchController* m_controller;
  FieldTool m_tool = FieldTool::Select;
  TeamColor m_team = TeamColor::Blue;
  Drag m_drag = Drag::None;
  bool m_moved = false;  // beyond the distance of an unsteady click
  QPointF m_from, m_at;
  std::vector<RobotPlacement> m_placements;
  RobotUid m_pivot;  // the robot whose handle is held
  Point m_ballFrom;  // where the ball was taken hold of
  std::vector<RobotUid> m_selectedBefore;
  std::vector<RobotPlacement> m_pending;
  std::uint64_t m_pendingSince = 0;  // serial of the frame they were made on
  bool m_clickedOneOfSeveral = false;
};

}  // namespace pitchboard::ui
