// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Everything that is shown of a match at one moment, whether simulated, live or recorded. Plain
// values; frames are immutable once they are published, and any thread may read them.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <base/game.h>
#include <base/log_line.h>
#include <robotlink/frame/live_values.h>
#include <robotlink/frame/robot_frame.h>
#include <robotlink/frame/teams.h>
#include <simcore/world/field.h>
#include <simcore/world/noise.h>
#include <simcore/world/referee_rules.h>
#include <simcore/world/rigid_body_state.h>
#include <simcore/world/snapshot.h>
#include <telemetry/drawings/drawing_store.h>

namespace pitchboard::link {

/// The source of a frame.
enum class FrameOrigin : std::uint8_t { Simulated, Live, Recorded };

/// Facts that seldom change during a match; its frames share one value.
struct FrameSettings {
  sim::FieldSpec field;
  sim::NoiseParameters noise;
  std::string physics;
  std::uint64_t seed = 0;
  double tickRate = 60.0;
  sim::RigidBodySettings rigidBody;
  bool operator==(const FrameSettings&) const = default;
};

struct MatchFrame {
  FrameOrigin origin = FrameOrigin::Simulated;
  /// False if the true poses are unknown. The robots' poses are then what they believe.
  bool truthKnown = true;
  bool ballKnown = true;     ///< false: ignore snapshot.ball
  std::uint64_t serial = 0;  ///< increases with every frame
  sim::GameSnapshot snapshot;
  std::vector<RobotFrame> robots;
  Teams teams;                                     ///< the table that RobotKey::team refers to
  std::vector<telemetry::RobotDrawings> drawings;  ///< drawings of robots (docs/drawings.md)
  std::string drawingProblem;                      ///< why the last drawing was refused; or empty
  std::optional<Game> game;                        ///< once a referee is known
  RefereeReception reception;                      ///< of a game that is received
  /// Of a simulated match, from which the studio finds out which calls are possible
  /// (sim::checkCall). Null without a referee, and for packets.
  std::shared_ptr<const sim::RefereeRules> rules;
  std::vector<TeamBall> teamBalls;  ///< of teams in which at least two robots agree
  double speed = 0.0;               ///< simulated seconds per second, measured over the last second
  double ticksPerSecond = 0.0;      ///< measured
  double tickMicroseconds = 0.0;    ///< mean time of a tick, measured
  bool paused = false;
  bool finished = false;  ///< a stop condition is met; the match has stopped
  std::shared_ptr<const FrameSettings> settings =
      std::make_shared<const FrameSettings>();  ///< never null
  /// The number of a simulated match if other programs can attach to its blackboards.
  std::optional<int> matchNumber;
  /// Speed of the slowest team program, times real time; nothing if all keep up.
  std::optional<double> slowestTeamProgram;
  bool nobodyPlays = false;         ///< SimulatedMatch::nobodyPlays()
  bool inLockStep = false;          ///< the match waits in every tick for some separate process
  std::string waitsFor;             ///< "B2 decision": delays lock-step; empty: none does
  std::string finishedBy;           ///< "goal", "ball_out", "duration"; empty unless finished
  std::uint64_t droppedEvents = 0;  ///< events that were not taken in time
  std::uint64_t droppedLogLines = 0;

  /// Returns this robot, or null.
  const RobotFrame* robot(RobotUid uid) const {
    const auto found = std::ranges::find(robots, uid, &RobotFrame::uid);
    return found == robots.end() ? nullptr : &*found;
  }
  /// Returns the robot that has this key at the moment, or null.
  const RobotFrame* robot(const RobotKey& key) const {
    const auto found = std::ranges::find(robots, key, &RobotFrame::key);
    return found == robots.end() ? nullptr : &*found;
  }
  /// Returns the robot of a simulated match with this blackboard, or null.
  const RobotFrame* robot(RobotId slot) const {
    const auto found = std::ranges::find(robots, slot, &RobotFrame::slot);
    return found == robots.end() ? nullptr : &*found;
  }
  /// Returns this key, or the next one with a free sender.
  RobotKey freeKey(RobotKey key) const {
    while (robot(key) != nullptr) ++key.sender;
    return key;
  }
  /// Sorts the robots in the order of lists.
  void sortRobots() {
    std::ranges::stable_sort(robots, {},
                             [this](const RobotFrame& robot) { return orderOf(robot.key, teams); });
  }
  /// Returns the slots of these robots of a simulated match; missing robots are left out.
  std::vector<RobotId> slotsOf(const std::vector<RobotUid>& uids) const {
    std::vector<RobotId> found;
    for (const RobotUid uid : uids) {
      if (const RobotFrame* one = robot(uid)) found.push_back(one->slot());
    }
    return found;
  }
};

}  // namespace pitchboard::link
