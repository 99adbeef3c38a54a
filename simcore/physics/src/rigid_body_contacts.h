// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Box2D as a pure function. A b2World lives as long as the solver, so that nothing is allocated
// per tick; but of one tick nothing is left for the next that could be told from its result:
// contacts are made from the caller's list, in its order, without warm starting or sleep, and the
// old ones stay only where the next list is the same. The world's own search for contacts, whose
// order depends on the history of its tree, is refused by a filter.
//
// What cannot change anything is left out: pairs that do not touch as the tick begins, bodies that
// then have no contact, and the search for moments of impact where the ways show that there are
// none. Where they do not show it, the tick is stepped again, with that search.
//
// Box2D has no public way to say which contacts there are and in which order, and without that a
// saved moment would not go on as it did. So rigid_body_contact_world.cpp casts away the const of
// the world's own contact manager: the one place, with the version of Box2D that the build asks for
// (2.4).

#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include <base/geometry.h>
#include <simcore/world/world_state.h>

#include "rigid_body_obstacles.h"

namespace pitchboard::sim::rigid {

inline double length(double x, double y) {
  return std::sqrt(x * x + y * y);
}

/// A robot, or the ball after the robots, that may touch something in this tick.
struct MovingBody {
  std::size_t body = 0;    ///< index of the robot, or the number of robots for the ball
  Point position;          ///< m; moved by solve()
  Velocity velocity;       ///< m/s, constant over the tick but for contacts; changed by solve()
  double reach = 0.0;      ///< m that it can move in this tick
  bool deflected = false;  ///< set by solve(): contacts changed its motion
};

/// Two things that may touch: indices into the list of moving bodies, or an obstacle as the second.
struct NearPair {
  std::size_t first = 0;
  std::size_t second = 0;
  bool obstacle = false;
  double restitution = 0.0;
  double overlap = 0.0;  ///< m at the start of the tick, 0 when apart
};

/// Of so many robots, the ball and what stands on the field.
constexpr std::size_t maxPairs(std::size_t robots) {
  return (robots + 1) * (robots + 2) / 2 + (robots + 1) * obstacleCount;
}

class ContactSolver {
 public:
  ContactSolver();
  ~ContactSolver();

  /// Makes sure that the bodies fit. Allocates only for a field, constants, or a number, size or
  /// weight of robots that the last few matches did not have.
  void prepare(const WorldState& world);
  /// Of the field that was prepared last.
  const Obstacles& obstacles() const;

  /// Moves the bodies through `dt` seconds. Pairs that are not listed do not touch.
  void solve(std::span<MovingBody> bodies, std::span<const NearPair> pairs, double dt);

 private:
  struct World;
  std::vector<std::unique_ptr<World>> m_worlds;  ///< the one in use first
};

}  // namespace pitchboard::sim::rigid
