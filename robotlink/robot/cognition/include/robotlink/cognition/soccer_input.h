// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The input of a soccer behaviour in a cycle: what the robot believes, sees and has been told. The
// decision process reads it from a blackboard, a rollout makes it from a sampled world; behaviours
// cannot tell the difference. Metres, radians, seconds; positions are in the studio's frame,
// bearings relative to the robot's heading, left positive. Plain values; any thread.

#include <array>
#include <optional>

#include <base/game.h>
#include <base/geometry.h>
#include <base/inline_vector.h>
#include <robotlink/cognition/act.h>
#include <simcore/world/robot_io.h>

namespace pitchboard::link {

using Points = InlineVector<Point, 22>;  ///< room for all robots of a match

/// The values of COM_REFEREE.
enum class Referee { None = 0, Stop = 1, Play = 2, Ready = 11, Set = 12 };

/// The values of DECISION_STATE and COM_ACTION_ROBOTn, described in resources/variables.json.
enum class Intention : int {
  None = 0,
  Idle = 1,
  Search = 2,
  Ball = 3,
  Support = 4,
  Keep = 5,
  Walk = 6
};

constexpr int maxTeamMates = 3;  ///< team-mates on the blackboard: COM_*_ROBOT1..3

struct TeamMate {
  Point position;
  Intention intention = Intention::None;
  bool active = false;        ///< a message came recently, and the robot is upright
  std::optional<Point> ball;  ///< where the team-mate sees the ball
  /// Returns whether the team-mate plays. Penalised robots report Idle, and robots with other
  /// behaviours None.
  bool takesPart() const {
    return active && intention != Intention::None && intention != Intention::Idle;
  }
};

/// Where the camera saw something, relative to the robot.
struct SeenAt {
  double distance = 0.0, bearing = 0.0;
};

struct SoccerInput {
  Referee referee = Referee::None;
  bool fallen = false;
  SetPlay setPlay = SetPlay::None;  ///< the current set play
  bool setPlayIsOurs = false;
  Pose believed;
  double sigma = 1e9;   ///< m, standard deviation of `believed`; a lost robot has a large one
  double imuYaw = 0.0;  ///< yaw from the IMU alone; 0 points to the opponents' goal
  Act doing;            ///< the action that control executes
  std::optional<SeenAt> ball;
  /// Opponents in view. Used only if the previous cycle asked vision to look for opponents.
  std::array<std::optional<SeenAt>, sim::Percepts::maxSeenRobots> robots;
  std::array<std::optional<TeamMate>, maxTeamMates> mates;
  Points matePlaces;         ///< positions of all known team-mates, at most ten
  double keeperShift = 0.0;  ///< m, from the robot's advisor: a keeper stands farther to its left
};

}  // namespace pitchboard::link
