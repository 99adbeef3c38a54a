// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The studio's hold on the match being simulated: owns the runner, polls it on the display timer,
// and hands frames, events and log lines to docks and field as values. Everything done by hand goes
// through here, as a command on the undo stack. UI thread only; never blocks on the match.

#include <QObject>
#include <QPointF>
#include <QString>
#include <memory>
#include <optional>
#include <vector>

#include <robotlink/match_runner.h>

class QTimer;
class QUndoStack;

namespace pitchboard::ui {

using FramePtr = std::shared_ptr<const link::MatchFrame>;

/// A robot and where it is to stand; for moving several at once.
struct RobotPlacement {
  RobotId id;
  Pose from;
  Pose to;
};

class MatchController : public QObject {
  Q_OBJECT
 public:
  explicit MatchController(link::MatchOptions options, QObject* parent = nullptr);
  ~MatchController() override;

  /// Ends the running match and starts this one; on failure the old one is gone, `errorOccurred`
  /// tells why and there is no frame.
  void open(const link::Scenario& scenario, bool paused = false);
  bool isOpen() const { return m_runner != nullptr; }
  const link::Scenario& scenario() const { return m_scenario; }
  FramePtr frame() const { return m_frame; }
  QUndoStack* undoStack() const { return m_undoStack; }

  // Transport.
  void setPaused(bool paused);
  void stepOnce();
  void setSpeed(double timesRealTime);   ///< link::MatchRunner::unlimitedSpeed = maximum
  void restart();                        ///< the scenario from its beginning

  // Edits by hand: take effect at once and can be undone.
  void moveRobots(const std::vector<RobotPlacement>& placements);
  void moveBall(Point from, Point to);
  void addRobot(TeamColor team, const Pose& pose, std::optional<int> number = {});
  void removeRobots(const std::vector<RobotId>& ids);

  // While a drag is going on the world follows, but only its end is one undoable command:
  /// Shows robots at their `to` pose without an entry on the undo stack.
  void previewRobots(const std::vector<RobotPlacement>& placements);
  void previewBall(Point position);

  // Not undoable: actions of the robots themselves.
  /// Writes DECISION_ACTION_A (and B when given) as the decision process would.
  void commandAction(RobotId id, int actionA, std::optional<int> actionB = {});
  void commandSearch(RobotId id, bool on);
  void setNoise(const sim::NoiseParameters& noise);
  void setBehaviour(RobotId id, const QString& behaviour);
  void setClockRunning(bool running);
  void resetScore();

  /// The present moment as a scenario, for saving.
  link::Scenario currentMoment();

 signals:
  void frameReceived(const pitchboard::ui::FramePtr& frame);
  void eventsReceived(const std::vector<pitchboard::sim::Event>& events);
  void logReceived(const std::vector<pitchboard::link::LogLine>& lines);
  void scenarioChanged();
  void errorOccurred(const QString& sentence);

 private:
  void poll();

  link::MatchOptions m_options;
  link::Scenario m_scenario;
  std::unique_ptr<link::MatchRunner> m_runner;
  FramePtr m_frame;
  QTimer* m_timer = nullptr;
  QUndoStack* m_undoStack = nullptr;
};

}  // namespace pitchboard::ui
