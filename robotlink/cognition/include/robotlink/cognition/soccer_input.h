// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a soccer behaviour is told in one cycle: what the robot believes, sees and has been told.
// The decision process reads it from a blackboard, a rollout makes it from a sampled world, and the
// behaviours cannot tell which. Metres, radians, seconds; places in the studio's frame, bearings
// from the robot's heading, left positive. Plain values; any thread.

#include <array>
#include <optional>

#include <base/geometry.h>
#include <base/inline_vector.h>
#include <robotlink/cognition/act.h>
#include <robotlink/cognition/advice.h>
#include <simcore/world/game_state.h>
#include <simcore/world/robot_io.h>

namespace pitchboard::link {

using Points = InlineVector<Point, 22>;  ///< as many as there are robots at most

/// The referee's word in COM_REFEREE.
enum class Referee { Silent = 0, Stop = 1, Play = 2, Ready = 11, Set = 12 };

/// DECISION_STATE and COM_ACTION_ROBOTn; their words are in resources/variables.json.
enum class Intention : int {
  None = 0,
  Idle = 1,
  Search = 2,
  Ball = 3,
  Support = 4,
  Keep = 5,
  Walk = 6
};

constexpr int mostTeamMates = 3;  ///< of whom all is known that they tell: COM_*_ROBOT1..3

struct TeamMate {
  Point position;
  Intention intention = Intention::None;
  bool active = false;        ///< heard of lately and standing
  std::optional<Point> ball;  ///< as it saw it
  /// In the game: whoever is penalised or plays by no behaviour of these says that it is idle, or
  /// nothing.
  bool takesPart() const {
    return active && intention != Intention::None && intention != Intention::Idle;
  }
};

/// Where the camera saw something.
struct SeenAt {
  double distance = 0.0, bearing = 0.0;
};

struct SoccerInput {
  Referee referee = Referee::Silent;
  bool fallen = false;
  sim::SetPlay setPlay = sim::SetPlay::None;  ///< that the referee has given
  bool setPlayIsOurs = false;
  Pose believed;
  double sigma = 1e9;   ///< m, of `believed`; large: the robot is lost
  double imuYaw = 0.0;  ///< by the IMU alone: 0 is the opponents' goal
  Act doing;            ///< what control carries out
  std::optional<SeenAt> ball;
  /// The opponents that are in view; looked at only after a cycle of Vision::Opponents.
  std::array<std::optional<SeenAt>, sim::Percepts::maxSeenRobots> robots;
  std::array<std::optional<TeamMate>, mostTeamMates> mates;
  Points matePlaces;    ///< of all team-mates that are known of, up to ten
  Advice advice;        ///< of the robot's advisor
  int adviceStamp = 0;  ///< changes when the advice is new
};

}  // namespace pitchboard::link
