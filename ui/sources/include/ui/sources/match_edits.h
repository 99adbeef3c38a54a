// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// All changes that the user makes to the simulated match. Those to robots, ball, physics and noise,
// and replacing the match, can be undone; those to processes and blackboard variables cannot. Every
// change by the user, including referee calls, goes through this class, because it refuses changes
// while the past is shown. Owned by MatchController. UI thread only; changes are carried out on the
// match's thread between two ticks.

#include <QObject>
#include <QString>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <robotlink/session/moment_reader.h>
#include <ui/sources/edit.h>
#include <ui/sources/match_controller.h>

class QUndoStack;

namespace pitchboard::ui {

/// A new pose for a robot.
struct RobotPlacement {
  RobotId id;
  Pose from;
  Pose to;
};

/// A part of an order that can be undone. Both functions run on the match's thread; `undo` is
/// called only after a successful `redo`.
struct EditStep {
  std::function<Result<void>(link::SimulatedMatch&)> redo, undo;
};

class MatchEdits : public QObject {
  Q_OBJECT
 public:
  explicit MatchEdits(MatchController* match);

  QUndoStack* undoStack() const { return m_undoStack; }
  /// Returns a robot of the match with its identity and behaviour; its pose is that at the start.
  const link::ScenarioRobot* robot(RobotId id) const;
  /// Returns the name of the physics model.
  const std::string& physics() const { return m_physics; }
  /// While locked, because the past is shown, the match cannot be changed. The first attempt emits
  /// `failed`.
  void setLocked(bool on);
  bool isLocked() const { return m_locked; }
  /// Returns the message why the match is locked.
  static QString lockedText();

  // The following functions do nothing while no match is open, and while locked.
  /// Returns whether the match may be changed; emits `failed` if it is locked.
  bool allowsChange();
  /// Carries out the edit and puts it on the undo stack, which it leaves again if the match refuses
  /// all of it.
  void perform(Edit edit);
  /// Carries out all steps between two ticks, or none of them. After a success they are one command
  /// on the undo stack. `whatFailed` as in MatchOrder, `mergeKey` as in Edit.
  void performOrder(const QString& text, const QString& whatFailed, std::vector<EditStep> steps,
                    const QString& mergeKey = {});
  /// Returns a new number for sim::RefereeCall::cause.
  std::uint32_t newCause() { return ++m_lastCause; }
  /// Makes a change that cannot be undone or is part of an edit, also in a match that is being
  /// opened.
  void order(MatchOrder change);
  void order(link::MatchRunner::Command change);

  /// Called when the match continues from this moment: takes over its robots and clears the undo
  /// stack.
  void adopt(const link::Moment& moment);

  // Edits that can be undone. What the match refuses does not stay on the undo stack.
  void moveRobots(const std::vector<RobotPlacement>& placements);
  /// The same for arrow keys and wheel: moves within a second become one command.
  void nudgeRobots(const std::vector<RobotPlacement>& placements);
  /// `velocity` is that of the ball at `to`, in m/s.
  void moveBall(Point from, Point to, Velocity velocity = {});
  void addRobot(TeamColor team, const Pose& pose, std::optional<int> number = {});
  void removeRobots(const std::vector<RobotId>& ids);
  /// Moves the robots to a team; each gets the smallest free shirt number there.
  void setTeam(const std::vector<RobotId>& ids, TeamColor team);
  /// Changes the shirt number; emits `failed` if a team-mate has it.
  void setNumber(RobotId id, int number);
  void setBehaviour(const std::vector<RobotId>& ids, const QString& behaviour);
  /// Returns whether the team thinks ahead (docs/advisor.md).
  bool isAdvised(TeamColor team) const { return m_advisors.contains(team); }
  void setAdvised(TeamColor team, bool on);
  /// Changes the robot model. Changes of the same robots within a second become one command.
  void setModel(const std::vector<RobotId>& ids, const sim::RobotModel& model);
  /// Changes the robot's runtime and restarts all of its processes.
  void setRuntime(RobotId id, const link::RuntimeChoice& choice);
  /// Changes the physics model, with which the match continues (Simulation::setPhysics()).
  void setPhysics(const QString& model);
  /// Replaces the match by another one; undoing continues the old match with its game, rows and
  /// events. `text` is for the undo menu, `done` for the signal `replaced`; for `between` see
  /// MatchController::replace(). Also allowed while the past is shown.
  void replaceMatch(const link::Scenario& scenario, const QString& text, const QString& done,
                    bool paused, std::function<void()> between = {});

  // Move robots and ball during a drag, without the undo stack; only its end is an undo command.
  void previewRobots(const std::vector<RobotPlacement>& placements);
  void previewBall(Point position);

  void setNoise(const sim::NoiseParameters& noise);
  void setRigidBody(const sim::RigidBodySettings& settings);
  void setClockRunning(bool running);
  void resetScore();

  // Changes that cannot be undone.
  /// Writes DECISION_ACTION_A, and B if given, like the decision process.
  void commandAction(RobotId id, int actionA, std::optional<int> actionB = {});
  void commandSearch(RobotId id, bool on);
  /// Writes a variable of the robot's blackboard between two ticks; `value` is converted to its
  /// type. `variableWritten` or the controller's `errorOccurred` follows.
  void writeVariable(RobotId id, const QString& name, double value);
  // Separate processes, by ProcessStatus::id.
  void startProcess(int process);
  void stopProcess(int process);
  void restartProcess(int process);
  void killProcess(int process);

 signals:
  void failed(const QString& sentence);
  void lockedChanged(bool on);
  /// Another match was started, and undo brings the old one back. `done` is such as "Match
  /// restarted".
  void replaced(const QString& done);
  /// Team, number, behaviour, runtime, advisor or model of a robot changed, by an edit, by undo, or
  /// back to the old value because the match refused the edit.
  void robotsChanged();
  void physicsChanged();
  /// `time` is the simulated time in s after which it was written.
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

  struct Attempt;
  /// The control that the user is moving.
  struct Gesture {
    sim::Setting setting{};
    std::uint32_t cause = 0;         // 0: none
    std::shared_ptr<bool> reported;  // whether its event was made; used on the match's thread
    QElapsedTimer age;               // since its last change
    QString mergeKey() const { return QStringLiteral("setting %1").arg(cause); }
  };
  void push(Edit edit);
  /// Sends an order to the match; while a command is carried out, as a part of it.
  void post(MatchOrder order);
  const EditCommand* lastEdit() const;
  /// Takes the last command off the stack if the match refused it.
  void dropRefused();
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
  void adviseTeam(TeamColor team, const std::optional<link::AdvisorOptions>& advisor);
  void takePhysics(const std::string& name);
  void switchPhysics(const std::string& name, const std::function<void(sim::Simulation&)>& report);
  /// Carries out the step and reports the change as an event, which undo takes back. Arguments as
  /// in performOrder().
  void changeSetting(sim::Setting setting, const QString& text, const QString& whatFailed,
                     EditStep step);

  MatchController* m_match;
  QUndoStack* m_undoStack;
  std::shared_ptr<Attempt> m_attempt;               // of the command that is being carried out
  std::map<RobotId, link::ScenarioRobot> m_robots;  // present or about to be
  std::map<TeamColor, link::AdvisorOptions> m_advisors;
  std::string m_physics;
  bool m_locked = false, m_reportedLocked = false;
  bool m_replacing = false;  // an edit opens a match: what was done before can still be undone
  std::uint32_t m_lastCause = 0;
  Gesture m_gesture;
};

}  // namespace pitchboard::ui
