// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a person did by hand, as undoable commands. Steps of the same kind within a second (arrow
// keys, a slider) become one command.

#include <QElapsedTimer>
#include <QUndoCommand>
#include <string>
#include <utility>
#include <vector>

#include <ui/sources/match_edits.h>

namespace pitchboard::ui {

class MatchRoster;

class PlacementCommand : public QUndoCommand {
 public:
  PlacementCommand(MatchRoster* roster, std::vector<RobotPlacement> placements);
  void redo() override;
  void undo() override;

 protected:
  /// The end of `later` becomes the end of this; false when it moves other robots.
  bool continueWith(const PlacementCommand& later);

 private:
  MatchRoster* m_roster;
  std::vector<RobotPlacement> m_placements;
};

/// Moved by arrow keys or turned by the wheel.
class NudgeCommand : public PlacementCommand {
 public:
  NudgeCommand(MatchRoster* roster, std::vector<RobotPlacement> placements);
  int id() const override { return 1; }
  bool mergeWith(const QUndoCommand* other) override;

 private:
  QElapsedTimer m_age;
};

class BallCommand : public QUndoCommand {
 public:
  BallCommand(MatchRoster* roster, Point from, Point to, Velocity velocity);
  void redo() override;
  void undo() override;

 private:
  MatchRoster* m_roster;
  Point m_from, m_to;
  Velocity m_velocity;
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

/// Another team or another number.
class IdentityCommand : public QUndoCommand {
 public:
  IdentityCommand(MatchRoster* roster, std::vector<sim::RobotIdentity> before,
                  std::vector<sim::RobotIdentity> after, const QString& words);
  void redo() override;
  void undo() override;

 private:
  MatchRoster* m_roster;
  std::vector<sim::RobotIdentity> m_before, m_after;
};

class BehaviourCommand : public QUndoCommand {
 public:
  struct Change {
    RobotId id;
    std::string before, after;
  };
  BehaviourCommand(MatchRoster* roster, std::vector<Change> changes);
  void redo() override;
  void undo() override;

 private:
  MatchRoster* m_roster;
  std::vector<Change> m_changes;
};

/// Robots become another kind of robot.
class ModelCommand : public QUndoCommand {
 public:
  using Models = std::vector<std::pair<RobotId, sim::RobotModel>>;
  ModelCommand(MatchRoster* roster, Models before, Models after);
  void redo() override;
  void undo() override;
  int id() const override { return 2; }
  bool mergeWith(const QUndoCommand* other) override;

 private:
  MatchRoster* m_roster;
  Models m_before, m_after;
  QElapsedTimer m_age;
};

/// Another model of motion and collisions.
class PhysicsCommand : public QUndoCommand {
 public:
  PhysicsCommand(MatchRoster* roster, std::string after);
  void redo() override;
  void undo() override;

 private:
  MatchRoster* m_roster;
  std::string m_before, m_after;
};

/// Another match, or this one anew. The moment that it leaves is kept to be gone back to.
class ReopenCommand : public QUndoCommand {
 public:
  /// `before`: the moment, of a match that began as `beginning`.
  ReopenCommand(MatchEdits* edits, link::Scenario before, link::Scenario beginning,
                link::Scenario after, const QString& words);
  void redo() override;
  void undo() override;

 private:
  MatchEdits* m_edits;
  link::Scenario m_before, m_beginning, m_after;
};

}  // namespace pitchboard::ui
