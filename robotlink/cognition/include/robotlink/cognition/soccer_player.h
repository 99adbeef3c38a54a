// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A soccer player without a blackboard: world model, behaviour and the walk to where it wants to
// go, which are the very ones of the processes decision and planning. Ten times a second it is told
// what it sees and believes, and answers with an action. Metres, radians, seconds; the studio's
// frame. One thread at a time.

#include <memory>
#include <optional>

#include <base/result.h>
#include <robotlink/cognition/behaviour_parameters.h>
#include <robotlink/cognition/soccer_input.h>
#include <simcore/world/field.h>
#include <simcore/world/robot_model.h>

namespace pitchboard::link {

struct SoccerPlayerOptions {
  sim::FieldSpec field;
  sim::RobotModel model;
  BehaviourChoice behaviour;
  bool facesLeft = false;  ///< attacks the left goal
};

struct PlayerDecision {
  Act act;
  bool search = false;             ///< the head shall turn to find the ball
  bool looksForOpponents = false;  ///< else for the ball
  Intention intention = Intention::None;
  std::optional<Point> ball;  ///< where it sees the ball itself, for its team
};

class SoccerPlayer {
 public:
  static constexpr double period = 0.1;  ///< s between two steps

  /// Fails on numbers out of their ranges, and with NotFound on a behaviour that plays without a
  /// pose.
  static Result<SoccerPlayer> create(const SoccerPlayerOptions& options);
  SoccerPlayer(SoccerPlayer&&) noexcept;
  SoccerPlayer& operator=(SoccerPlayer&&) noexcept;
  ~SoccerPlayer();

  /// Has in mind what `other` has; both were made with the same options. Allocates nothing.
  void copyMind(const SoccerPlayer& other);
  /// Takes note of what is seen without deciding anything: how it gets to know what it knew before
  /// the first cycle.
  void observe(const SoccerInput& input, double now);
  /// One cycle. Allocates nothing once the thread has planned a path round as many robots.
  PlayerDecision step(const SoccerInput& input, double now);

 private:
  struct Parts;
  explicit SoccerPlayer(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> m_parts;
};

}  // namespace pitchboard::link
