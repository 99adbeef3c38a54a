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
#include <set>
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
  Pose from;  ///< of what the user took hold of
  Pose to;
};

/// A part of an edit. Both functions run on the match's thread; `undo` is called only after a
/// successful `redo`.
struct EditStep {
  std::function<Result<void>(link::SimulatedMatch&)> redo, undo;
};

/// Puts a robot there; undone, it stands where it was.
EditStep placementStep(RobotId id, const Pose& pose);
/// Puts the ball there, with this velocity in m/s; undone, it moves where and as it did.
EditStep ballStep(Point to, Velocity velocity = {});

/// A change of the match that can be undone.
struct MatchEdit {
  QString text;                 ///< name in the undo menu
  QString whatFailed;           ///< as in MatchOrder
  std::vector<EditStep> steps;  ///< all of them are carried out between two ticks, or none
  QString mergeKey = {};        ///< as in Edit
  /// What the studio knows of the match, changed as soon as the edit is sent, and changed back if
  /// it is refused or undone. UI thread.
  std::function<void()> note = {}, takeBack = {};
  link::Changed changes = link::Changed::Yes;  ///< as in MatchOrder
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
  /// Carries out the edit, also in a match that is being opened. Once the match has made the
  /// change, it is one command on the undo stack; what the match refuses is reported and leaves no
  /// command.
  void perform(MatchEdit edit);
  /// Returns a new number for sim::RefereeCall::cause.
  std::uint32_t newCause() { return ++m_lastCause; }
  /// Makes a change that cannot be undone, also in a match that is being opened.
  void order(MatchOrder change);
  void order(link::MatchRunner::Command change);

  /// Returns the scenario with what was set up by hand: robots that were added, removed or changed,
  /// the advisors, physics and noise. Robots keep the places that they have in the scenario.
  link::Scenario setUp(link::Scenario scenario) const;
  /// Called when the match continues from this moment: takes over its robots and clears the undo
  /// stack.
  void adopt(const link::Moment& moment);

  // Edits that can be undone, as perform() carries them out.
  void moveRobots(const std::vector<RobotPlacement>& placements);
  /// The same for arrow keys and wheel: moves within a second become one command.
  void nudgeRobots(const std::vector<RobotPlacement>& placements);
  /// `velocity` is that of the ball at `to`, in m/s.
  void moveBall(Point to, Velocity velocity = {});
  void addRobot(TeamColor team, const Pose& pose, std::optional<int> number = {});
  void removeRobots(const std::vector<RobotId>& ids);
  /// Returns why this team cannot have a robot: with a referee two teams play. Empty: it can.
  QString whyNoTeam(TeamColor team) const;
  /// Moves the robots to a team; each gets the smallest free shirt number there.
  void setTeam(const std::vector<RobotId>& ids, TeamColor team);
  /// Returns whether another robot of the team wears this number.
  bool isTaken(const sim::RobotIdentity& wanted) const;
  /// Changes the shirt number; emits `failed` if a team-mate has it.
  void setNumber(RobotId id, int number);
  void setBehaviour(const std::vector<RobotId>& ids, const QString& behaviour);
  /// Returns whether the team's keeper has an advisor (docs/advisor.md).
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
  /// A change that can be undone was sent to the match; answered() follows once it is carried out
  /// and on the stack, or refused, or lost with its match.
  void sent();
  void answered(bool done);
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

  struct Performed;  // an edit on its way to the undo stack, or on it
  /// The control that the user is moving.
  struct Gesture {
    sim::Setting setting{};
    std::uint32_t cause = 0;         // 0: none
    std::shared_ptr<bool> reported;  // whether its event was made; used on the match's thread
    QElapsedTimer age;               // since its last change
    QString mergeKey() const { return QStringLiteral("setting %1").arg(cause); }
  };
  void carryOut(const std::shared_ptr<Performed>& edit, std::function<void()> onSuccess = {},
                const std::function<void()>& onFailure = {});
  void takeBack(const std::shared_ptr<Performed>& edit);
  const EditCommand* lastEdit() const;
  /// Takes the last command off the stack if the match refused to make its change again.
  void dropRefused();
  void answer(bool done);
  void orderProcesses(const std::function<void(link::ProcessManager&)>& what);
  /// Gives robots these values, in what is known of them here.
  template <class Value>
  void note(const Field<Value>& field, const Values<Value>& values);
  /// Changes those that have another value. `text` and the field's `whatFailed`: %1 becomes who
  /// they are.
  template <class Value>
  void change(const Field<Value>& field, Values<Value> values, const QString& text,
              const QString& mergeKey = {});
  /// "B1", "3 robots".
  template <class Items>
  QString subjectOf(const Items& items, RobotId first) const;
  /// The smallest shirt number that no robot of the team and none of `taken` wears.
  int freeNumber(TeamColor team, const std::vector<int>& taken = {}) const;
  bool refusesTaken(const sim::RobotIdentity& wanted);
  void performPlacements(const std::vector<RobotPlacement>& placements, const QString& mergeKey);
  void noteRobots(const std::vector<link::ScenarioRobot>& robots, bool present);
  void noteAdvisor(TeamColor team, const std::optional<link::AdvisorOptions>& advisor);
  void takePhysics(const std::string& name);
  /// Carries out the step and reports the change as an event, which undo takes back. Arguments as
  /// in MatchEdit.
  void changeSetting(sim::Setting setting, const QString& text, const QString& whatFailed,
                     EditStep step);

  MatchController* m_match;
  QUndoStack* m_undoStack;
  std::map<RobotId, link::ScenarioRobot> m_robots;  // present or about to be
  std::set<RobotId> m_added;                        // by hand: each stands where it was put
  std::map<TeamColor, link::AdvisorOptions> m_advisors;
  std::string m_physics;
  int m_unanswered = 0;
  bool m_locked = false, m_reportedLocked = false;
  bool m_replacing = false;  // an edit opens a match: what was done before can still be undone
  std::uint32_t m_lastCause = 0;
  Gesture m_gesture;
};

}  // namespace pitchboard::ui
