// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Moves robots and ball through one tick. What cannot touch anything in this tick is moved
// directly; the rest goes through Box2D (rigid_body_contacts.h), and what then still overlaps is
// pushed apart, so that a tick ends without overlaps. Things that a person dragged onto each other
// part at a walking pace instead of at once.

#include <vector>

#include <simcore/world/ball_rolling.h>

#include "rigid_body_contacts.h"
#include "rigid_body_separation.h"
#include "rigid_body_tick.h"

namespace pitchboard::sim::rigid {

class Collisions {
 public:
  /// Reads Motion::velocity and noise of every robot and writes positions, the velocities that came
  /// out, the gait's speeds of robots that were stopped or pushed, and Motion::push and stopped.
  void advance(Tick& tick);

 private:
  void updateRolling(double share, double dt);
  void findNeighbours(const Tick& tick);
  std::size_t addBody(const Tick& tick, std::size_t body);
  void addPushes(Tick& tick) const;
  void separate(const Tick& tick);
  void writeBack(Tick& tick);

  double m_share = -1.0, m_dt = 0.0;  ///< of which m_rolling is
  RollingShare m_rolling;
  ContactSolver m_solver;
  Separation m_separation;
  Velocity m_ballVelocity;                 ///< mean over the tick, m/s
  std::vector<double> m_x, m_y, m_radius;  ///< of the robots, side by side for the search
  std::vector<MovingBody> m_bodies;        ///< those that may touch something
  std::vector<std::size_t> m_slots;        ///< per body: index into m_bodies + 1, 0 = not there
  std::vector<double> m_radii;             ///< of these, m
  std::vector<NearPair> m_pairs;
};

}  // namespace pitchboard::sim::rigid
