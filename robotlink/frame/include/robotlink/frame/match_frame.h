// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a person sees of a match at one moment, whatever its source: simulated, live or recorded.
// Plain values; frames are immutable once handed out.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <base/log_line.h>
#include <robotlink/frame/live_values.h>
#include <robotlink/frame/robot_frame.h>
#include <robotlink/frame/teams.h>
#include <simcore/world/field.h>
#include <simcore/world/game_state.h>
#include <simcore/world/noise.h>
#include <simcore/world/referee_rules.h>
#include <simcore/world/rigid_body_state.h>
#include <simcore/world/snapshot.h>
#include <telemetry/wire/drawing_store.h>

namespace pitchboard::link {

/// Where a frame comes from. The same values everywhere; what is not known says so.
enum class FrameOrigin : std::uint8_t { Simulated, Live, Recorded };

/// What hardly ever changes while a match goes on: its frames share one value.
struct FrameSettings {
  sim::FieldSpec field;
  sim::NoiseParameters noise;
  std::string physics;
  std::uint64_t seed = 0;
  double tickRate = 60.0;
  sim::RigidBodySettings rigidBody;
  bool operator==(const FrameSettings&) const = default;
};

/// What a person who referees a simulated match decides by (sim::checkCall).
struct RefereeDesk {
  sim::GameState game;
  sim::RefereeRules rules;
};

struct MatchFrame {
  FrameOrigin origin = FrameOrigin::Simulated;
  /// False: nobody knows the true poses. The robots' poses are then what they believe.
  bool truthKnown = true;
  bool ballKnown = true;     ///< false: snapshot.ball means nothing
  std::uint64_t serial = 0;  ///< grows with every frame
  sim::GameSnapshot snapshot;
  std::vector<RobotFrame> robots;
  Teams teams;                                     ///< what RobotKey::team counts
  std::vector<telemetry::RobotDrawings> drawings;  ///< of the robots' programs (docs/drawings.md)
  std::string drawingProblem;                      ///< why the last one was not drawn; or empty
  std::optional<RefereeView> referee;              ///< once one was heard
  std::string refereeRules;                 ///< of a simulated match; empty: without a referee
  std::shared_ptr<const RefereeDesk> desk;  ///< null: nobody can call
  std::vector<TeamBall> teamBalls;          ///< of teams of which at least two robots agree
  double speed = 0.0;             ///< simulated seconds per second, measured over the last second
  double ticksPerSecond = 0.0;    ///< measured
  double tickMicroseconds = 0.0;  ///< mean time of a tick, measured
  bool paused = false;
  bool finished = false;  ///< a stop condition of the scenario is met; it stands still
  std::shared_ptr<const FrameSettings> settings =
      std::make_shared<const FrameSettings>();  ///< never null
  /// Of a match that shares blackboards with other programs of this computer.
  std::optional<int> matchNumber;
  /// What the slowest of a team's own programs manages, times real time; nothing: all keep up.
  std::optional<double> slowestTeamProgram;
  bool nobodyPlays = false;         ///< SimulatedMatch::nobodyPlays()
  bool inLockStep = true;           ///< separate reference processes are waited for in every tick
  std::string finishedBy;           ///< "goal", "ball_out", "duration"; empty unless finished
  std::uint64_t droppedEvents = 0;  ///< nobody took them in time
  std::uint64_t droppedLogLines = 0;

  /// This robot; null when it is not there.
  const RobotFrame* robot(const RobotKey& key) const {
    const auto found = std::ranges::find(robots, key, &RobotFrame::key);
    return found == robots.end() ? nullptr : &*found;
  }
  /// The robot of a simulated match with this blackboard; null when it is not there.
  const RobotFrame* robot(RobotId slot) const {
    const auto found = std::ranges::find(robots, slot, &RobotFrame::slot);
    return found == robots.end() ? nullptr : &*found;
  }
  /// This key, or the next sender's that no robot has.
  RobotKey freeKey(RobotKey key) const {
    while (robot(key) != nullptr) ++key.sender;
    return key;
  }
  /// Puts the robots in the order in which they are listed.
  void sortRobots() {
    std::ranges::stable_sort(robots, {},
                             [this](const RobotFrame& robot) { return orderOf(robot.key, teams); });
  }
  /// For orders to robots of a simulated match: their slots, without those that are not there.
  std::vector<RobotId> slotsOf(const std::vector<RobotKey>& keys) const {
    std::vector<RobotId> found;
    for (const RobotKey& key : keys) {
      if (const RobotFrame* one = robot(key)) found.push_back(one->slot());
    }
    return found;
  }
};

}  // namespace pitchboard::link
