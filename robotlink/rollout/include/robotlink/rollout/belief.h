// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What is known of a game at one moment, and how surely: what rollouts sample their worlds from.
// Metres, radians, seconds, the studio's frame; standard deviations are those of one axis. Plain
// values; any thread.

#include <cstdint>
#include <vector>

#include <base/geometry.h>
#include <robotlink/cognition/behaviour_parameters.h>
#include <simcore/world/field.h>
#include <simcore/world/game_state.h>
#include <simcore/world/rigid_body_state.h>
#include <simcore/world/robot_model.h>

namespace pitchboard::rollout {

enum class Side : std::uint8_t { Left, Right };  ///< of the field, where a team's own goal is
constexpr Side lastOf(Side) {
  return Side::Right;
}

/// Who plays, which does not change from rollout to rollout.
struct Player {
  Side side = Side::Left;
  link::BehaviourChoice behaviour;
  sim::RobotModel model;
};

struct Setup {
  sim::FieldSpec field;
  sim::RigidBodySettings body;
  sim::NoiseParameters noise;
  std::vector<Player> players;
  double tickRate = 20.0;  ///< per second; a multiple of 10 up to 120
};

struct RobotBelief {
  Pose pose;
  double sigma = 0.1, yawSigma = 0.05;
  double forward = 0.0, left = 0.0, turn = 0.0;  ///< m/s and rad/s of its gait
  bool absent = false;                           ///< penalised or not in the game
  bool down = false;
  double getsUpIn = 0.0;  ///< s; only while it is down
};

struct BallBelief {
  Point place;         ///< where it was last seen
  double sigma = 0.1;  ///< m, at that time
  double age = 0.0;    ///< s since then
  Velocity velocity;   ///< at that time
  double velocitySigma = 0.1;
};

struct GameBelief {
  int goalsLeft = 0, goalsRight = 0;  ///< of the team whose own goal is the left or right one
  double secondsLeft = 600.0;         ///< rollouts end with the half
  sim::PlayState state = sim::PlayState::Playing;
  sim::SetPlay setPlay = sim::SetPlay::None;  ///< the other side keeps away while it lasts
  Side setPlaySide = Side::Left;
  double setPlayLeft = 0.0;  ///< s, at most
};

struct Belief {
  std::vector<RobotBelief> robots;  ///< of each player, in the same order
  BallBelief ball;
  GameBelief game;
};

}  // namespace pitchboard::rollout
