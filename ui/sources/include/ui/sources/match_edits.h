// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Everything that is done by hand to the match being simulated: robots and ball are placed, added,
// removed, get another behaviour, number or model, the match gets another physics or noise, or is
// replaced, all of which can be undone; processes and words of the blackboards, which cannot.
// It is the one gate for all changes by hand: whoever has a change of its own (the referee)
// performs or orders it here, and nothing passes while the past is shown. Belongs to the
// MatchController and ends with it. UI thread only; what is ordered is carried out on the match's
// thread between two ticks.

#include <QObject>
#include <QString>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <robotlink/session/moment_reader.h>
#include <ui/sources/edit.h>
#include <ui/sources/match_controller.h>

class QUndoStack;

namespace pitchboard::ui {

/// A robot and where it is to stand; for moving several at once.
struct RobotPlacement {
  RobotId id;
  Pose from;
  Pose to;
};

/// A part of an order that can be undone; both on the match's thread. `undo` follows only a `redo`
/// that succeeded.
struct EditStep {
  std::function<Result<void>(link::SimulatedMatch&)> redo, undo;
};

class MatchEdits : public QObject {
  Q_OBJECT
 public:
  explicit MatchEdits(MatchController* match);

  QUndoStack* undoStack() const { return m_undoStack; }
  /// A robot as this match knows it (identity and behaviour; the pose is that of its entry).
  const link::ScenarioRobot* robot(RobotId id) const;
  /// The name of its physics model.
  const std::string& physics() const { return m_physics; }
  /// While on, nothing that is done by hand reaches the match: a person looks at another moment of
  /// it. The first attempt is answered by `failed`.
  void setLocked(bool on);
  bool isLocked() const { return m_locked; }
  /// Why, for people.
  static QString lockedText();

  // The gate. Each does nothing when no match is open, and while locked.
  /// Whether the match may be changed; when it is locked, `failed` says why.
  bool allowsChange();
  /// Does the edit and puts it on the undo stack.
  void perform(Edit edit);
  /// Carried out in one go between two ticks, all of them or none. On the undo stack as one command
  /// once the match has carried it out, and not when it refused. `whatFailed`: as in MatchOrder;
  /// `mergeKey`: as in Edit.
  void performOrder(const QString& text, const QString& whatFailed, std::vector<EditStep> steps,
                    const QString& mergeKey = {});
  /// For events that follow from one decision by hand (sim::RefereeCall::cause): another one each
  /// time.
  std::uint32_t newCause() { return ++m_lastCause; }
  /// A change that cannot be undone, or a part of an edit. Reaches a match that is being opened,
  /// too.
  void order(MatchOrder change);
  void order(link::MatchRunner::Command change);

  /// The match goes on from this moment: its robots are known, and nothing can be undone.
  void adopt(const link::Moment& moment);

  // Edits by hand: take effect at once and can be undone.
  void moveRobots(const std::vector<RobotPlacement>& placements);
  /// The same by arrow keys and wheel: those of a second become one command, but never one with a
  /// drag.
  void nudgeRobots(const std::vector<RobotPlacement>& placements);
  /// `velocity`: with which it leaves `to`, m/s.
  void moveBall(Point from, Point to, Velocity velocity = {});
  void addRobot(TeamColor team, const Pose& pose, std::optional<int> number = {});
  void removeRobots(const std::vector<RobotId>& ids);
  /// These robots play for another team, each with the smallest shirt number that is free there.
  void setTeam(const std::vector<RobotId>& ids, TeamColor team);
  /// Another number on the shirt; `failed` when a team-mate wears it.
  void setNumber(RobotId id, int number);
  /// Another decision process takes the robots over.
  void setBehaviour(const std::vector<RobotId>& ids, const QString& behaviour);
  /// They become robots of this kind. Changes of one thing within a second are one command.
  void setModel(const std::vector<RobotId>& ids, const sim::RobotModel& model);
  /// The model of motion and collisions: the match goes on with it (Simulation::setPhysics()).
  void setPhysics(const QString& model);
  /// Another match in place of this one; undone, this one goes on where it was, with its game, rows
  /// and events. `text`: what the undo menu calls it; `done`: what `replaced` says; `between`: see
  /// MatchController::replace(). Also while the past is shown.
  void replaceMatch(const link::Scenario& scenario, const QString& text, const QString& done,
                    bool paused, std::function<void()> between = {});

  // While a drag is going on the world follows, but only its end is one undoable command:
  /// Shows robots at their `to` pose without an entry on the undo stack.
  void previewRobots(const std::vector<RobotPlacement>& placements);
  void previewBall(Point position);

  // Undoable, too; refused ones leave no step:
  void setNoise(const sim::NoiseParameters& noise);
  void setRigidBody(const sim::RigidBodySettings& settings);
  void setClockRunning(bool running);
  void resetScore();
  /// Who runs for the robot; all its processes start anew.
  void setRuntime(RobotId id, const link::RuntimeChoice& choice);

  // Not undoable: actions of the robots themselves.
  /// Writes DECISION_ACTION_A (and B when given) as the decision process would.
  void commandAction(RobotId id, int actionA, std::optional<int> actionB = {});
  void commandSearch(RobotId id, bool on);
  /// Writes one word of the robot's blackboard between two ticks, as any process could; `value` is
  /// converted to the variable's type. `variableWritten` follows, or the
  /// controller's `errorOccurred`.
  void writeVariable(RobotId id, const QString& name, double value);
  // One of the separate processes, by ProcessStatus::id.
  void startProcess(int process);
  void stopProcess(int process);
  void restartProcess(int process);
  void killProcess(int process);

 signals:
  void failed(const QString& sentence);
  void lockedChanged(bool on);
  /// Another match is played, and undo brings back the one before: "Match restarted".
  void replaced(const QString& done);
  /// A robot got another team, number, behaviour, runtime or model: by hand, by undo, or because
  /// the match refused it and it is as before.
  void robotsChanged();
  /// physics() changed: by hand, by undo, or with another match.
  void physicsChanged();
  /// `time`: of the tick after which it was written, simulated s.
  void variableWritten(pitchboard::RobotId id, const QString& name, double time);

 private:
  template <class Value>
  using Values = std::vector<std::pair<RobotId, Value>>;
  template <class Value>
  struct Field;
  static const Field<sim::RobotIdentity> identityField;
  static const Field<std::string> behaviourField;
  static const Field<sim::RobotModel> modelField;
  static const Field<link::RuntimeChoice> runtimeField;

  void orderProcesses(const std::function<void(link::ProcessManager&)>& what);
  /// Gives known robots these values, here and in the match.
  template <class Value>
  void set(const Field<Value>& field, const Values<Value>& values);
  /// The same as an edit, for those that have another value. `text`: %1 becomes who they are.
  template <class Value>
  void change(const Field<Value>& field, Values<Value> values, const QString& text,
              const QString& mergeKey = {});
  /// "B1", "3 robots".
  template <class Items>
  QString subjectOf(const Items& items, RobotId first) const;
  /// The smallest shirt number that no robot of the team and none of `taken` wears.
  int freeNumber(TeamColor team, const std::vector<int>& taken = {}) const;
  bool wearsAnother(const sim::RobotIdentity& wanted);
  void performPlacements(const std::vector<RobotPlacement>& placements, const QString& mergeKey);
  void insert(const link::ScenarioRobot& robot);
  void erase(RobotId id);
  void placeRobots(const std::vector<RobotPlacement>& placements, Pose RobotPlacement::*where);
  void placeBall(Point position, Velocity velocity = {});
  void takePhysics(const std::string& name);
  void switchPhysics(const std::string& name);

  MatchController* m_match;
  QUndoStack* m_undoStack;
  std::map<RobotId, link::ScenarioRobot> m_robots;  // present or about to be
  std::string m_physics;
  bool m_locked = false, m_toldLocked = false;
  bool m_replacing = false;  // an edit opens a match: what was done before can still be undone
  std::uint32_t m_lastCause = 0;
};

}  // namespace pitchboard::ui
