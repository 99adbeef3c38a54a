// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A soccer player without a blackboard, for rollouts. It consists of the world model, behaviour and
// path planning that the processes decision and planning use. Ten times a second it gets what the
// robot sees and believes, and returns an action. Metres, radians, seconds; the studio's frame. One
// thread at a time.

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
  bool search = false;             ///< turn the head to find the ball
  bool looksForOpponents = false;  ///< vision looks for opponents; false: for the ball
  Intention intention = Intention::None;
  std::optional<Point> ball;  ///< where the player itself sees the ball; sent to its team
};

class SoccerPlayer {
 public:
  static constexpr double period = 0.1;  ///< s between two steps

  /// Error InvalidArgument if a parameter is out of its range, NotFound if the behaviour does not
  /// use the pose.
  static Result<SoccerPlayer> create(const SoccerPlayerOptions& options);
  SoccerPlayer(SoccerPlayer&&) noexcept;
  SoccerPlayer& operator=(SoccerPlayer&&) noexcept;
  ~SoccerPlayer();

  /// Copies everything that `other`, which must have the same options, remembers. Allocates
  /// nothing.
  void copyState(const SoccerPlayer& other);
  /// Updates the world model without a decision. Called before the first step to pass what the
  /// player already knows.
  void observe(const SoccerInput& input, double now);
  /// Runs one cycle at `now` (s). Allocates nothing once its thread has planned a path around as
  /// many robots.
  PlayerDecision step(const SoccerInput& input, double now);

 private:
  struct Parts;
  explicit SoccerPlayer(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> m_parts;
};

}  // namespace pitchboard::link
