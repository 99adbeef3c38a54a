// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The b2World of a ContactSolver (rigid_body_contacts.h): one body for each robot and the ball,
// what stands on the field, and the contacts that it is told to have. Box2D's units: ten to the
// metre, because its tolerances are made for things of 0.1 to 10 units. Owned by its solver; one
// thread.

#include <box2d/box2d.h>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "rigid_body_contacts.h"

namespace pitchboard::sim::rigid {

inline constexpr double unitsPerMetre = 10.0;

inline float units(double metres) {
  return static_cast<float>(metres * unitsPerMetre);
}
inline b2Vec2 units(double x, double y) {
  return {units(x), units(y)};
}

/// Refuses the contacts that Box2D finds by itself.
class OnlyListedContacts final : public b2ContactFilter {
 public:
  bool ShouldCollide(b2Fixture*, b2Fixture*) override { return open; }
  bool open = false;
};

class ContactWorld {
 public:
  explicit ContactWorld(const WorldState& state);
  /// Made for such robots, ball and field.
  bool fits(const WorldState& state) const;

  std::size_t robots() const { return m_robots; }
  const Obstacles& obstacles() const { return m_obstacles; }
  b2Body& body(const MovingBody& moving) { return *m_bodies[moving.body]; }
  /// Distance at which a pair touches.
  double touchingOf(std::span<const MovingBody> moving, const NearPair& pair) const;

  /// Puts a body where it begins, awake.
  void place(const MovingBody& moving);
  /// From now on the `chosen` of the pairs are all the contacts there are, in their order.
  void list(std::span<const MovingBody> moving, std::span<const NearPair> pairs,
            std::span<const std::size_t> chosen);
  /// A contact lives while its boxes overlap: makes that of a body cover all that it can reach.
  void spreadBox(const MovingBody& moving);
  void step(float dt, bool impacts);

 private:
  using Proxies = std::pair<b2FixtureProxy*, b2FixtureProxy*>;
  /// All that its bodies depend on but for the robots.
  struct Ground {
    double length = 0.0, width = 0.0, border = 0.0;
    double goalWidth = 0.0, goalDepth = 0.0, postRadius = 0.0;
    double ballRadius = 0.0, ballMass = 0.0;
    bool operator==(const Ground&) const = default;
  };
  struct Size {
    double radius = 0.0, mass = 0.0;
    bool operator==(const Size&) const = default;
  };
  static Ground groundOf(const SimulationSettings& settings);
  static Size sizeOf(const WorldState& state, std::size_t robot);

  b2ContactManager& manager();
  void addBody(std::size_t index);
  void addObstacles();
  void findProxies();
  void warmUp();
  void clearContacts();
  Proxies proxiesOf(std::span<const MovingBody> moving, const NearPair& pair) const;

  OnlyListedContacts m_filter;
  b2World m_world{b2Vec2{0.0F, 0.0F}};
  Ground m_ground;
  Obstacles m_obstacles;
  std::size_t m_robots;
  std::vector<Size> m_sizes;
  std::vector<b2Body*> m_bodies;           // robots, then the ball
  std::vector<b2FixtureProxy*> m_proxies;  // robots, ball, obstacles
  std::vector<Proxies> m_listed;           // whose contacts stand, in their order
  std::vector<Proxies> m_wanted;           // scratch
};

}  // namespace pitchboard::sim::rigid
