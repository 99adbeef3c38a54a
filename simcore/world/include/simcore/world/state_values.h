// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The one list of all values of a WorldState. Everything that must not miss a value goes through
// it: the hash, saved states, and comparisons. The order is that of declaration, except for the
// surface of the field. World is WorldState or const WorldState. Pure functions; any thread.
//
// A visitor has these functions:
//   value(v)                  for each std::string, double, bool, int, std::uint32_t, std::uint64_t
//                             and enumeration
//   count(vector)             before the elements of a vector; a reader resizes it here
//   sameCount(vector, size)   the same where the size follows from another vector
//   alternative(variant)      before the values of the physics model; a reader selects it here
//   present(optional)         before an optional value; a reader creates it here. Returns whether
//                             there is one
//   repeats(vector, index)    may be missing. Returns true if this element equals the one before it
//                             and must not be visited
//   label(v, form)            may be missing: values that are shown but do not affect the match, so
//                             that the hash leaves them out. Saved states have them since `form`

#include <cstdint>
#include <type_traits>

#include <simcore/world/world_state.h>

namespace pitchboard::sim {
namespace state_values {

// Forms of saved states (robotlink/sessions/session/src/state_codec.cpp).
inline constexpr std::uint64_t form7 = 7, form8 = 8;

template <class Visitor, class... Values>
void all(Visitor& visitor, Values&... values) {
  (visitor.value(values), ...);
}

template <class Field, class Visitor>
void field(Field& f, Visitor& v) {
  all(v, f.name, f.length, f.width, f.border, f.goalWidth, f.goalDepth, f.goalHeight,
      f.goalPostRadius, f.goalAreaLength, f.goalAreaWidth, f.penaltyAreaLength, f.penaltyAreaWidth,
      f.penaltyMarkDistance, f.centreCircleDiameter, f.lineWidth, f.ballRadius, f.ballMass,
      f.robotRadius);
  if constexpr (requires { v.label(f.markDiameter, form8); }) {
    v.label(f.markDiameter, form8);
    v.label(f.cornerArcRadius, form8);
  }
}

template <class Noise, class Visitor>
void noise(Noise& n, Visitor& v) {
  all(v, n.forward, n.sideways, n.rotation, n.kickSpeed, n.kickAngle, n.visionDistance,
      n.visionBearing, n.robotDistance, n.robotBearing, n.landmarkBearing, n.landmarkProbability,
      n.missedDetection, n.visionDelay, n.imuWhite, n.imuDrift, n.ofModel);
}

template <class Surface, class Visitor>
void surface(Surface& s, Visitor& v) {
  all(v, s.keptPerFrame, s.deceleration);
}

/// The surface of the field is visited here, where version 0.8 had it, so that saved states of 0.8
/// can be read and hashes of matches on the published field stay the same.
template <class Body, class Surface, class Visitor>
void rigidBody(Body& s, Surface& ofField, Visitor& v) {
  all(v, s.ballMass);
  surface(ofField, v);
  all(v, s.postRestitution, s.robotRestitution, s.falls);
}

template <class Model, class Visitor>
void robotModel(Model& m, Visitor& v) {
  all(v, m.name, m.forwardFast, m.forwardSlow, m.backwardFast, m.backwardSlow, m.sideways, m.turn,
      m.aroundSideways, m.aroundTurn, m.maxAcceleration, m.maxYawAcceleration, m.kickLaw,
      m.kickSpeed, m.weakKickSpeed, m.passSpeed, m.kickReach, m.kickOuter, m.kickInner, m.footSide,
      m.footWidth, m.kickTime, m.kickContact, m.radius, m.mass, m.fallImpulse, m.getUpFront,
      m.getUpBack, m.headSpeed, m.panLimit, m.fieldOfView, m.visionRange, m.cameraForward,
      m.cameraHeight, m.fromCamera);
  if constexpr (requires { v.label(m.batteryFull, form7); }) {
    v.label(m.batteryFull, form7);
    v.label(m.batteryLow, form7);
    v.label(m.batteryEmpty, form7);
  }
  noise(m.noise, v);
}

/// Visits an alternative of WorldState::physics.
template <class Physics, class Visitor>
void physics(Physics& state, Visitor& v) {
  using State = std::remove_const_t<Physics>;
  if constexpr (std::is_same_v<State, RigidBodyState>) {
    v.count(state.robots);
    for (auto& r : state.robots) {
      all(v, r.pose.position.x, r.pose.position.y, r.pose.yaw, r.forwardSpeed, r.sidewaysSpeed,
          r.yawRate, r.velocity.x, r.velocity.y, r.headYaw, r.panRight, r.action, r.actionB,
          r.inMotion, r.posture, r.getUpRemaining, r.kickElapsed, r.imuZero, r.imuDrift);
    }
    auto& ball = state.ball;
    all(v, ball.position.x, ball.position.y, ball.velocity.x, ball.velocity.y);
    v.count(state.past);
    for (auto& moment : state.past) {
      all(v, moment.ball.x, moment.ball.y);
      v.sameCount(moment.robots, state.robots.size());
      for (auto& r : moment.robots) {
        all(v, r.there, r.down, r.pose.position.x, r.pose.position.y, r.pose.yaw, r.headYaw);
      }
    }
  } else if constexpr (std::is_same_v<State, PublishedState>) {
    v.count(state.robots);
    for (auto& r : state.robots) {
      all(v, r.x, r.y, r.rotate, r.view, r.panRight, r.action, r.front, r.turn, r.drift, r.inMotion,
          r.orientationError);
    }
    auto& ball = state.ball;
    all(v, ball.x, ball.y, ball.vx, ball.vy, ball.friction);
  } else {
    static_assert(sizeof(Physics) == 0, "list the values of this state of a physics model here");
  }
}

}  // namespace state_values

/// Visits everything except the referee's rules and the game.
template <class World, class Visitor>
void visitWorld(World& world, Visitor& v) {
  auto& s = world.settings;
  state_values::all(v, s.physics, s.tickRate, s.seed, s.afterGoal);
  state_values::field(s.field, v);
  state_values::noise(s.noise, v);
  state_values::rigidBody(s.rigidBody, s.field.surface, v);
  state_values::all(v, world.tick, world.score.left, world.score.right, world.clockRunning,
                    world.clockTicks);
  v.count(world.robots);
  for (auto& r : world.robots) state_values::all(v, r.id.value, r.team, r.number, r.imuStartsAt180);
  v.sameCount(world.models, world.robots.size());
  for (std::size_t i = 0; i < world.models.size(); ++i) {
    if constexpr (requires { v.repeats(world.models, i); }) {
      if (v.repeats(world.models, i)) continue;
    }
    state_values::robotModel(world.models[i], v);
  }
  v.sameCount(world.statistics, world.robots.size());
  for (auto& r : world.statistics) {
    state_values::all(v, r.distanceWalked, r.kicks, r.falls, r.unknownActions, r.lastUnknownAction);
  }
  v.alternative(world.physics);
  std::visit([&v](auto& state) { state_values::physics(state, v); }, world.physics);
}

template <class Settings, class Visitor>
void visitTeamSettings(Settings& s, Visitor& v) {
  v.count(s.teams);
  for (auto& t : s.teams) state_values::all(v, t.colour, t.number, t.name);
}

/// Visits everything.
template <class World, class Visitor>
void visitValues(World& world, Visitor& v) {
  visitWorld(world, v);
  auto& s = world.settings;
  if (v.present(s.referee)) {
    visitRefereeRules(*s.referee, [&v](auto&... values) { state_values::all(v, values...); });
    visitTeamSettings(s, v);
  }
  if (v.present(world.game)) visitGame(*world.game, world.refereeMemory, v);
}

}  // namespace pitchboard::sim
