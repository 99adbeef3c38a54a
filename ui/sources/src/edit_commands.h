// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a person did by hand on the field, as undoable commands. Moves of the same things within a
// second (arrow keys) become one command.

#include <QElapsedTimer>
#include <QUndoCommand>
#include <vector>

#include <ui/sources/match_edits.h>

namespace pitchboard::ui {

class MatchRoster;

class PlacementCommand : public QUndoCommand {
 public:
  PlacementCommand(MatchRoster* roster, std::vector<RobotPlacement> placements);
  void redo() override;
  void undo() override;
  int id() const override { return 1; }
  bool mergeWith(const QUndoCommand* other) override;

 private:
  MatchRoster* m_roster;
  std::vector<RobotPlacement> m_placements;
  QElapsedTimer m_age;
};

class BallCommand : public QUndoCommand {
 public:
  BallCommand(MatchRoster* roster, Point from, Point to);
  void redo() override;
  void undo() override;
  int id() const override { return 2; }
  bool mergeWith(const QUndoCommand* other) override;

 private:
  MatchRoster* m_roster;
  Point m_from, m_to;
  QElapsedTimer m_age;
};

class AddRobotCommand : public QUndoCommand {
 public:
  AddRobotCommand(MatchRoster* roster, link::ScenarioRobot robot);
  void redo() override;
  void undo() override;

 private:
  MatchRoster* m_roster;
  link::ScenarioRobot m_robot;
};

class RemoveRobotsCommand : public QUndoCommand {
 public:
  RemoveRobotsCommand(MatchRoster* roster, std::vector<link::ScenarioRobot> robots);
  void redo() override;
  void undo() override;

 private:
  MatchRoster* m_roster;
  std::vector<link::ScenarioRobot> m_robots;  // with the poses they had
};

class TeamCommand : public QUndoCommand {
 public:
  TeamCommand(MatchRoster* roster, std::vector<sim::RobotIdentity> before,
              std::vector<sim::RobotIdentity> after);
  void redo() override;
  void undo() override;

 private:
  MatchRoster* m_roster;
  std::vector<sim::RobotIdentity> m_before, m_after;
};

}  // namespace pitchboard::ui
