// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A belief: what is known about a game at one moment, with its uncertainty. Rollouts sample their
// worlds from it. Metres, radians, seconds, the studio's frame; standard deviations are per axis.
// Plain values; any thread.

#include <cstdint>
#include <vector>

#include <base/game.h>
#include <base/geometry.h>
#include <robotlink/cognition/behaviour_parameters.h>
#include <simcore/world/field.h>
#include <simcore/world/rigid_body_state.h>
#include <simcore/world/robot_model.h>

namespace pitchboard::rollout {

enum class Side : std::uint8_t { Left, Right };  ///< the side of a team's own goal
constexpr Side lastOf(Side) {
  return Side::Right;
}

struct Player {
  Side side = Side::Left;
  link::BehaviourChoice behaviour;
  sim::RobotModel model;
};

/// Everything that is the same in all rollouts.
struct Setup {
  sim::FieldSpec field;
  sim::RigidBodySettings body;
  sim::NoiseParameters noise;
  std::vector<Player> players;
  double tickRate = 20.0;  ///< ticks per second; a multiple of 10 up to 120
};

struct RobotBelief {
  Pose pose;
  double sigma = 0.1, yawSigma = 0.05;
  double forward = 0.0, left = 0.0, turn = 0.0;  ///< speed of its gait, m/s and rad/s
  bool absent = false;                           ///< penalised or not in the game
  bool down = false;
  double getsUpIn = 0.0;  ///< s until it stands again; only if `down`
};

struct BallBelief {
  Point place;         ///< where it was last seen
  double sigma = 0.1;  ///< m, when it was last seen
  double age = 0.0;    ///< s since it was last seen
  Velocity velocity;   ///< when it was last seen
  double velocitySigma = 0.1;
};

struct GameBelief {
  int goalsLeft = 0, goalsRight = 0;  ///< scored by the team that defends this side
  double secondsLeft = 600.0;         ///< time left of the half, at whose end rollouts end
  PlayState state = PlayState::Playing;
  SetPlay setPlay = SetPlay::None;  ///< while it lasts, the opponents keep away
  Side setPlaySide = Side::Left;    ///< the team that takes it
  double setPlayLeft = 0.0;         ///< s until it is over
};

struct Belief {
  std::vector<RobotBelief> robots;  ///< in the order of Setup::players
  BallBelief ball;
  GameBelief game;
};

}  // namespace pitchboard::rollout
