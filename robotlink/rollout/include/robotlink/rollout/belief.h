// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A belief: what is known about a game at one moment, with its uncertainty. Rollouts sample their
// worlds from it. Metres, radians, seconds, the studio's frame; standard deviations are per axis.
// Plain values; any thread.

#include <cstdint>
#include <vector>

#include <base/geometry.h>
#include <robotlink/cognition/behaviour_parameters.h>
#include <simcore/world/field.h>
#include <simcore/world/game_state.h>
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
  /// Other parameters of this behaviour that the player may have. RobotBelief::shares has the
  /// probability of each.
  std::vector<link::BehaviourParameters> variants;
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
  /// Probability of each of Player::variants; empty: all 0. The rest, up to 1, is the probability
  /// of Player::behaviour.
  std::vector<double> shares;
  double pace = 1.0, paceSigma = 0.0;  ///< its speed as a share of what its model says
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
  sim::PlayState state = sim::PlayState::Playing;
  sim::SetPlay setPlay = sim::SetPlay::None;  ///< while it lasts, the opponents keep away
  Side setPlaySide = Side::Left;              ///< the team that takes it
  double setPlayLeft = 0.0;                   ///< s until it is over
};

struct Belief {
  std::vector<RobotBelief> robots;  ///< in the order of Setup::players
  BallBelief ball;
  GameBelief game;
};

}  // namespace pitchboard::rollout
