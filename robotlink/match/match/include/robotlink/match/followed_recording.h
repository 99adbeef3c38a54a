// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What some robots and the ball of a simulated match follow: the poses of a recording. In each
// tick, SimulatedMatch puts followers where they were recorded at its end before the physics moves
// anything, so that percepts and contacts are those of the recorded poses; their processes run, but
// do not command them. All are let go at once when another robot has changed what they would react
// to. Metres, radians, seconds of the match that follows. Plain values; any thread.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <base/geometry.h>
#include <base/ids.h>

namespace pitchboard::link {

struct FollowedPose {
  double time = 0.0;
  Pose pose;
  bool operator==(const FollowedPose&) const = default;
};

/// Recorded poses in order of time. Between two of them everything moves in a straight line, but at
/// most for `longestMove` before the second one: recordings keep no pose of a robot that stands.
struct RecordedTrack {
  static constexpr double longestMove = 0.3;
  std::vector<FollowedPose> poses;
  /// Returns nothing before the first pose; after the last one, returns that.
  std::optional<Pose> at(double time) const;
};

struct FollowedRobot {
  RobotId id;
  bool follows = false;  ///< otherwise it plays, and the track tells where it was recorded
  RecordedTrack track;
};

struct FollowedRecording {
  static constexpr double defaultReach = 0.5;
  /// A robot or ball that is farther than this from where it was recorded counts as elsewhere.
  static constexpr double elsewhere = 0.2;

  /// Followers are let go when a robot that does not follow, and is elsewhere than recorded, is
  /// this near the ball or one of them (between the centres).
  double reach = defaultReach;
  bool ballFollows = false;  ///< until a robot that does not follow touches it
  bool believed = false;     ///< followed poses, or the ball, are what robots believed
  double end = 0.0;          ///< when the recording ends, and everything is let go
  std::vector<FollowedRobot> robots;
  RecordedTrack ball;
};

/// How a match follows a recording at the moment.
struct FollowState {
  bool follows = false;  ///< some robot or the ball follows
  bool moved = false;    ///< in the last tick; its commands do not tell what happened in it
  /// When everything was let go, and why, as a clause: "B1 is 0.48 m from the ball".
  std::optional<double> letGoAt{};
  std::string why{};
};

}  // namespace pitchboard::link
