// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the parts of the rigid-body model hand to each other during one tick: the world that is
// being advanced, and per robot what control asked for and what collisions made of it. Metres,
// radians, seconds. Scratch memory of the model; nothing here outlives a tick but the memory itself
// and the sine and cosine of a yaw, which are remembered by its bits.

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include <simcore/world/ball_way.h>
#include <simcore/world/event.h>
#include <simcore/world/world_state.h>

namespace pitchboard::sim::rigid {

/// Cosine and sine of the last yaw asked for; computed anew only when its bits change.
class Heading {
 public:
  void set(double yaw) {
    if (std::bit_cast<std::uint64_t>(yaw) == std::bit_cast<std::uint64_t>(m_yaw)) return;
    m_yaw = yaw;
    m_cos = std::cos(yaw);
    m_sin = std::sin(yaw);
  }
  double cos() const { return m_cos; }
  double sin() const { return m_sin; }

 private:
  double m_yaw = std::numeric_limits<double>::quiet_NaN();
  double m_cos = 1.0;
  double m_sin = 0.0;
};

/// One robot's motion in this tick.
struct Motion {
  Heading heading;        ///< after this tick's turn
  double forward = 0.0;   ///< m/s at the start of the tick, for the accelerometer
  double sideways = 0.0;  ///< m/s at the start of the tick
  double turned = 0.0;    ///< rad turned in this tick, noise included
  Velocity velocity;      ///< m/s that the gait asks for, in the field's frame
  Point noise;            ///< m by which noise displaces the robot in this tick
  Velocity impulse;       ///< N·s received from contacts in this tick
};

/// The tick that is being computed.
struct Tick {
  WorldState& world;
  RigidBodyState& state;
  std::vector<Motion>& motions;
  std::vector<Event>& events;
  double dt = 0.0;          ///< s
  double sqrtFrames = 0.0;  ///< root of the tick in 1/60 s: scales noise given per 1/60 s
  BallWay ball = {};        ///< set by the collisions

  const SimulationSettings& settings() const { return world.settings; }
  void report(EventKind kind, std::size_t robot, int value = 0) {
    events.push_back({kind, world.tick, world.robots[robot].id, value});
  }
};

/// The same direction in (−π, π], never −0, quick for angles that already lie there.
inline double wrapped(double angle) {
  constexpr double pi = std::numbers::pi;
  if (angle > -pi && angle <= pi) return angle + 0.0;
  const double rest = std::remainder(angle, 2.0 * pi);
  return rest <= -pi ? pi : rest + 0.0;
}

}  // namespace pitchboard::sim::rigid
