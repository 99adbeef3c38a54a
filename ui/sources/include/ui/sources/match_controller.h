// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The studio's hold on the match being simulated: owns the runner, polls it on the display timer,
// and hands frames, events and log lines to docks and field as values. Everything done by hand goes
// through here, as a command on the undo stack. UI thread only. Matches are made and ended on a
// worker thread; only currentMoment() and stateHash() wait, for the tick in progress.

#include <QObject>
#include <QPointF>
#include <QString>
#include <QThreadPool>
#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <robotlink/match/match_runner.h>
#include <robotlink/session/recorded_frame.h>
#include <robotlink/session/state_archive.h>
#include <ui/sources/frame_source.h>

class QTimer;
class QUndoStack;

namespace pitchboard::link {
class MatchSampler;
}
namespace pitchboard::telemetry {
class RowSink;
}

namespace pitchboard::ui {

class MatchRows;

/// A robot and where it is to stand; for moving several at once.
struct RobotPlacement {
  RobotId id;
  Pose from;
  Pose to;
};

class MatchController : public FrameSource {
  Q_OBJECT
 public:
  explicit MatchController(link::MatchOptions options, QObject* parent = nullptr);
  ~MatchController() override;

  /// Ends the running match and starts this one, both on a worker thread: returns at once. Until
  /// `opened` there is no frame and isOpening() holds; orders given meanwhile reach the new match,
  /// edits that can be undone are ignored. Opening again supersedes what was not started yet.
  /// On failure the old match is gone and `errorOccurred` tells why. When separate processes cannot
  /// be had (a key is in use), the match plays with inline processes on heap blackboards and
  /// `errorOccurred` says so.
  void open(const link::Scenario& scenario, bool paused = false);
  /// Ends the match; its processes and blackboards go, on the worker thread. restart() plays it
  /// again.
  void close();
  bool isOpen() const { return m_runner != nullptr; }
  bool isOpening() const { return m_opening; }
  const link::Scenario& scenario() const { return m_scenario; }
  SourceKind kind() const override { return SourceKind::Simulate; }
  FramePtr frame() const override { return m_frame; }
  std::shared_ptr<const telemetry::SeriesStore> series() const override;
  QString emptyText() const override;
  FramePtr frameAt(double time) const override;
  QUndoStack* undoStack() const { return m_undoStack; }
  /// Where the robots' processes run: as asked for, or Inline when that was not possible.
  link::Cognition cognition() const { return m_cognition; }
  /// What the next match is made with.
  const link::MatchOptions& options() const { return m_options; }
  /// Names of the blackboards' words, for the next match on; the published ones at first.
  void setCatalog(std::shared_ptr<const link::VariableCatalog> catalog);
  const link::VariableCatalog& nextCatalog() const { return *m_nextCatalog; }
  /// Those of the match that is open or being opened.
  const link::VariableCatalog& catalog() const { return *m_catalog; }

  // Transport.
  void setPaused(bool paused);
  void stepOnce();
  /// Plays at full speed up to this tick of the match, then pauses; for repeatable pictures.
  void runTo(std::uint64_t tick);
  void setSpeed(double timesRealTime);  ///< link::MatchRunner::unlimitedSpeed = maximum
  double speed() const { return m_speed; }
  bool isPaused() const { return m_paused; }
  void restart();  ///< the scenario from its beginning
  /// The same; `between` runs on the worker thread when the old match is gone and the new one is
  /// not made yet.
  void restartAfter(std::function<void()> between);

  // Edits by hand: take effect at once and can be undone.
  void moveRobots(const std::vector<RobotPlacement>& placements);
  void moveBall(Point from, Point to);
  void addRobot(TeamColor team, const Pose& pose, std::optional<int> number = {});
  void removeRobots(const std::vector<RobotId>& ids);
  /// These robots play for another team, each with the smallest shirt number that is free there.
  void setTeam(const std::vector<RobotId>& ids, TeamColor team);

  // While a drag is going on the world follows, but only its end is one undoable command:
  /// Shows robots at their `to` pose without an entry on the undo stack.
  void previewRobots(const std::vector<RobotPlacement>& placements);
  void previewBall(Point position);

  // Not undoable: actions of the robots themselves.
  /// Writes DECISION_ACTION_A (and B when given) as the decision process would.
  void commandAction(RobotId id, int actionA, std::optional<int> actionB = {});
  void commandSearch(RobotId id, bool on);
  /// Rows are kept of every n-th tick (1: each), from now on. Waits for the tick in progress.
  void setSampling(int everyNth);
  int sampling() const { return m_everyNth; }
  /// Of the match that is open: whoever wants its rows is added here, on its thread.
  std::shared_ptr<link::MatchSampler> sampler() const { return m_sampler; }
  /// Where other blackboards of this computer are sampled to: their rows get the match's time.
  /// Another one after `restarted`; null while there is no match.
  std::shared_ptr<telemetry::RowSink> rowsBeside() const;
  /// Writes one word of the robot's blackboard between two ticks, as any process could; `value` is
  /// converted to the variable's type. `variableWritten` follows, or `errorOccurred`.
  void writeVariable(RobotId id, const QString& name, double value);
  void setNoise(const sim::NoiseParameters& noise);
  void setRigidBody(const sim::RigidBodySettings& settings);
  /// The model of motion and collisions: starts the present moment anew with it.
  void setPhysics(const QString& model);
  /// Another decision process takes the robot over.
  void setBehaviour(RobotId id, const QString& behaviour);
  /// Ends the robot's processes and starts them again.
  void restartProcesses(RobotId id);
  void stopProcesses(RobotId id);
  void setClockRunning(bool running);
  void resetScore();

  /// The present moment as a scenario, for saving. Waits for the tick in progress.
  link::Scenario currentMoment();
  /// Hash of the simulation's state at the present tick. Waits for the tick in progress.
  std::uint64_t stateHash();

  /// The exact states of the recent past; another one after `restarted`, null while there is no
  /// match. Bytes that the rows of a match may take; the oldest leave first. At once and for
  /// matches to come.
  void setMemoryBudget(std::size_t bytes);
  std::shared_ptr<const link::StateArchive> archive() const { return m_archive; }
  /// Puts the match back to this moment (s) exactly, pauses, and forgets what came after it and
  /// what could be undone. `errorOccurred` when memory does not hold it any more.
  void continueFrom(double time);
  /// Sees every tick from now on, until stopObserving() or `ending`. False: there is no match.
  bool observe(std::shared_ptr<link::TickObserver> observer);
  /// Waits for the tick in progress.
  void stopObserving(const std::shared_ptr<link::TickObserver>& observer);

  /// A robot as this match knows it (identity and behaviour; the pose is that of its entry).
  const link::ScenarioRobot* robot(RobotId id) const;

 signals:
  void ending();            ///< the match goes now: its observers see it for the last time
  void scenarioChanged();   ///< another match is being opened, or none; `restarted` follows
  void opened();            ///< it is there, or failed
  void transportChanged();  ///< paused, speed, or whether there is a match
  void errorOccurred(const QString& sentence);
  /// `time`: of the tick after which it was written, simulated s.
  void variableWritten(pitchboard::RobotId id, const QString& name, double time);

 private:
  friend class AddRobotCommand;
  friend class RemoveRobotsCommand;
  friend class PlacementCommand;
  friend class BallCommand;
  friend class TeamCommand;

  struct Opening;  ///< what the worker made
  void poll();
  void openAfter(const link::Scenario& scenario, bool paused, std::function<void()> between);
  /// Forgets the match; the worker ends it.
  std::shared_ptr<link::MatchRunner> retire();
  void take(Opening& opening);
  /// To the match, or to the one that is being opened.
  void post(link::MatchRunner::Command command);
  /// Runs on the match's thread; a failure comes back as errorOccurred with `whatFailed` before it,
  /// after `onFailure` has run here.
  void postChecked(const QString& whatFailed,
                   std::function<Result<void>(link::SimulatedMatch&)> command,
                   std::function<void()> onFailure = {});
  void insertRobot(const link::ScenarioRobot& robot);
  void eraseRobot(RobotId id);
  void changeIdentities(const std::vector<sim::RobotIdentity>& identities);
  void placeRobots(const std::vector<RobotPlacement>& placements, bool back);
  void placeBall(Point position);

  link::MatchOptions m_options;
  link::Cognition m_cognition = link::Cognition::Inline;
  link::Scenario m_scenario;
  std::map<RobotId, link::ScenarioRobot> m_robots;  // present, or about to be
  std::shared_ptr<const link::VariableCatalog> m_nextCatalog, m_catalog;
  std::shared_ptr<link::MatchRunner> m_runner;  // keeps its catalog
  FramePtr m_frame;
  std::size_t m_memoryBudget = std::size_t{1} << 30;
  std::shared_ptr<MatchRows> m_rows;
  std::shared_ptr<link::MatchSampler> m_sampler;
  std::shared_ptr<link::StateArchive> m_archive;
  mutable std::unique_ptr<link::RecordedFrames> m_past;  // rebuilds frames; made when asked for
  int m_everyNth = 1;
  double m_speed = 1.0;
  bool m_paused = false;
  bool m_opening = false;
  std::optional<std::uint64_t> m_runTo;  // once it is open
  std::vector<link::MatchRunner::Command> m_whenOpen;
  std::atomic<std::uint64_t> m_generation = 0;  // of the match; grows with every open() and close()
  QThreadPool m_worker;                         // one thread: matches end and start in order
  QTimer* m_timer = nullptr;
  QUndoStack* m_undoStack = nullptr;
};

}  // namespace pitchboard::ui
