// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Moves what follows a recording, tick by tick, and decides when to let go (followed_recording.h).
// Match thread. Private to the module.

#include <memory>
#include <optional>
#include <span>
#include <string>

#include <robotlink/match/followed_recording.h>
#include <simcore/simulation/simulation.h>
#include <simcore/world/snapshot.h>

namespace pitchboard::link {

class Following {
 public:
  void begin(std::shared_ptr<const FollowedRecording> recording);
  /// Before a step: puts followers where they are recorded at its end, stops their gait, and gives
  /// the ball the speed with which it arrives at its recorded place.
  void place(sim::Simulation& simulation, std::span<sim::RobotCommand> commands);
  /// After the step: undoes what contacts did to followers. Returns whether it let go.
  bool settle(sim::Simulation& simulation);

  const FollowState& state() const { return m_state; }
  /// The recording that is or was followed; null if none was.
  const FollowedRecording* recording() const { return m_recording.get(); }

 private:
  const FollowedRobot* recorded(RobotId id) const;
  bool follows(RobotId id) const;
  void placeRobots(sim::Simulation& simulation, double time) const;
  void settleBall(sim::Simulation& simulation);
  bool isTouched(const sim::Simulation& simulation) const;
  std::string nearBy(const sim::RobotSnapshot& robot, const sim::Snapshot& now, double time) const;
  std::string whyLetGo(const sim::Simulation& simulation, double time) const;

  std::shared_ptr<const FollowedRecording> m_recording;
  FollowState m_state;
  bool m_ballFollows = false;
  bool m_touched = false;             // the ball, by a robot that does not follow
  std::optional<Point> m_ballTarget;  // of this tick
  Velocity m_ballVelocity;
};

}  // namespace pitchboard::link
