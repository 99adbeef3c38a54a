// SPDX-License-Identifier: GPL-3.0-or-later
#include "rigid_body_contacts.h"

#include <box2d/box2d.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <mutex>

namespace pitchboard::sim::rigid {
namespace {

constexpr double unitsPerMetre = 10.0;
constexpr double longestStep = 1.0 / 60.0;  // s; slower ticks are divided
// Box2D caps the way of one step at b2_maxTranslation; stay below.
constexpr double longestWay = 1.5 / unitsPerMetre;  // m
constexpr int velocityIterations = 8;
constexpr std::size_t mostWorlds = 4;  // kinds of matches in one thread, in turn
// Overlaps are the caller's to resolve, in double and smoothly.
constexpr int positionIterations = 0;

float units(double metres) {
  return static_cast<float>(metres * unitsPerMetre);
}
b2Vec2 units(double x, double y) {
  return {units(x), units(y)};
}

/// Refuses the contacts that Box2D finds by itself.
class OnlyListedContacts final : public b2ContactFilter {
 public:
  bool ShouldCollide(b2Fixture*, b2Fixture*) override { return open; }
  bool open = false;
};

/// Adds up the impulses of each body's contacts.
class ImpulseSum final : public b2ContactListener {
 public:
  void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override {
    b2WorldManifold manifold;
    contact->GetWorldManifold(&manifold);
    float sum = 0.0F;
    for (int i = 0; i < impulse->count; ++i) sum += impulse->normalImpulses[i];
    add(contact->GetFixtureA(), -sum * manifold.normal);
    add(contact->GetFixtureB(), sum * manifold.normal);
  }

  std::vector<b2Vec2> sums;  // by body

 private:
  void add(b2Fixture* fixture, const b2Vec2& impulse) {
    const std::uintptr_t body = fixture->GetUserData().pointer;
    if (body < sums.size()) sums[body] += impulse;
  }
};

/// Collects the broad-phase proxy of every fixture.
class ProxyCollector {
 public:
  ProxyCollector(const b2BroadPhase& broadPhase, std::vector<b2FixtureProxy*>& out)
      : m_broadPhase(broadPhase), m_out(out) {}
  bool QueryCallback(int32 id) {
    auto* proxy = static_cast<b2FixtureProxy*>(m_broadPhase.GetUserData(id));
    m_out[proxy->fixture->GetUserData().pointer] = proxy;
    return true;
  }

 private:
  const b2BroadPhase& m_broadPhase;
  std::vector<b2FixtureProxy*>& m_out;
};

}  // namespace

struct ContactSolver::World {
  struct Size {
    double radius = 0.0, mass = 0.0;
    bool operator==(const Size&) const = default;
  };
  static Size sizeOf(const WorldState& state, std::size_t robot) {
    return {robotRadius(state, robot), state.models[robot].mass};
  }
  bool fits(const WorldState& state) const {
    if (robots != state.robots.size() || !(field == state.settings.field) ||
        !(constants == state.settings.rigidBody)) {
      return false;
    }
    for (std::size_t i = 0; i < robots; ++i) {
      if (!(sizes[i] == sizeOf(state, i))) return false;
    }
    return true;
  }

  explicit World(const WorldState& state)
      : field(state.settings.field),
        obstacles(obstaclesOf(field)),
        constants(state.settings.rigidBody),
        robots(state.robots.size()) {
    for (std::size_t i = 0; i < robots; ++i) sizes.push_back(sizeOf(state, i));
    world.SetContactFilter(&filter);
    world.SetContactListener(&impulses);
    world.SetWarmStarting(false);
    world.SetContinuousPhysics(true);
    impulses.sums.resize(robots + 1);
    for (std::size_t i = 0; i <= robots; ++i) addBody(i);
    addObstacles();
    proxies.resize(robots + 1 + obstacleCount);
    ProxyCollector collector(manager().m_broadPhase, proxies);
    b2AABB everywhere;
    everywhere.lowerBound.Set(-1e6F, -1e6F);
    everywhere.upperBound.Set(1e6F, 1e6F);
    manager().m_broadPhase.Query(&collector, everywhere);
    warmUp();
  }

  /// The world hands its contact manager out as constant; it is our own world all the same.
  b2ContactManager& manager() { return const_cast<b2ContactManager&>(world.GetContactManager()); }

  void addBody(std::size_t index) {
    const bool isBall = index == robots;
    b2BodyDef def;
    def.type = b2_dynamicBody;
    def.fixedRotation = true;
    def.bullet = isBall;
    def.awake = false;
    b2Body* body = world.CreateBody(&def);
    b2CircleShape shape;
    shape.m_radius = units(isBall ? field.ballRadius : sizes[index].radius);
    const double mass = isBall ? constants.ballMass : sizes[index].mass;
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.density =
        static_cast<float>(mass / (static_cast<double>(b2_pi) * shape.m_radius * shape.m_radius));
    fixture.friction = 0.0F;
    fixture.userData.pointer = index;
    body->CreateFixture(&fixture);
    bodies.push_back(body);
  }

  void addObstacles() {
    const b2BodyDef def;
    b2Body* ground = world.CreateBody(&def);
    for (std::size_t i = 0; i < obstacles.size(); ++i) {
      const Obstacle& o = obstacles[i];
      b2FixtureDef fixture;
      b2CircleShape circle;
      b2EdgeShape edge;
      if (o.first == o.last) {
        circle.m_p = units(o.first.x, o.first.y);
        circle.m_radius = units(o.radius);
        fixture.shape = &circle;
      } else {
        edge.SetTwoSided(units(o.first.x, o.first.y), units(o.last.x, o.last.y));
        fixture.shape = &edge;
      }
      fixture.friction = 0.0F;
      fixture.userData.pointer = robots + 1 + i;
      ground->CreateFixture(&fixture);
    }
  }

  /// Everything at one place and in contact once, so that Box2D's pools and buffers have the size
  /// that they can ever need.
  void warmUp() {
    // Box2D registers its kinds of contact on first use, in a static table.
    static std::mutex registration;
    const std::lock_guard lock(registration);
    for (b2Body* body : bodies) body->SetTransform({0.0F, 0.0F}, 0.0F);
    world.Step(0.0F, velocityIterations, positionIterations);
    filter.open = true;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      for (std::size_t j = i + 1; j < bodies.size(); ++j) {
        manager().AddPair(proxies[i], proxies[j]);
      }
      for (std::size_t k = 0; k < obstacleCount; k += obstacleCount / 4) {
        manager().AddPair(proxies[i], proxies[robots + 1 + k]);
      }
    }
    filter.open = false;
    clearContacts();
    for (b2Body* body : bodies) body->SetAwake(false);
  }

  void clearContacts() {
    while (manager().m_contactList) manager().Destroy(manager().m_contactList);
  }

  OnlyListedContacts filter;
  ImpulseSum impulses;
  b2World world{b2Vec2{0.0F, 0.0F}};
  FieldSpec field;
  Obstacles obstacles;
  RigidBodySettings constants;
  std::size_t robots;
  std::vector<Size> sizes;
  std::vector<b2Body*> bodies;           // robots, then the ball
  std::vector<b2FixtureProxy*> proxies;  // robots, ball, obstacles
};

ContactSolver::ContactSolver() = default;
ContactSolver::~ContactSolver() = default;

void ContactSolver::prepare(const WorldState& world) {
  const auto fits = [&world](const auto& one) { return one->fits(world); };
  const auto found = std::find_if(m_worlds.begin(), m_worlds.end(), fits);
  if (found == m_worlds.begin() && found != m_worlds.end()) return;
  if (found != m_worlds.end()) {
    std::rotate(m_worlds.begin(), found, found + 1);
    return;
  }
  if (m_worlds.size() == mostWorlds) m_worlds.pop_back();
  m_worlds.insert(m_worlds.begin(), std::make_unique<World>(world));
}

const Obstacles& ContactSolver::obstacles() const {
  return m_worlds.front()->obstacles;
}

void ContactSolver::solve(std::span<MovingBody> bodies, std::span<const NearPair> pairs,
                          double dt) {
  World& w = *m_worlds.front();
  double longest = 0.0;
  for (const MovingBody& moving : bodies) {
    b2Body* body = w.bodies[moving.body];
    body->SetTransform(units(moving.position.x, moving.position.y), 0.0F);
    body->SetAwake(true);
    body->SetLinearVelocity(units(moving.velocity.x, moving.velocity.y));
    w.impulses.sums[moving.body].SetZero();
    longest = std::max(longest, moving.reach);
  }

  w.filter.open = true;
  for (const NearPair& pair : pairs) {
    b2FixtureProxy* first = w.proxies[bodies[pair.first].body];
    b2FixtureProxy* second =
        w.proxies[pair.obstacle ? w.robots + 1 + pair.second : bodies[pair.second].body];
    w.manager().AddPair(first, second);
    w.manager().m_contactList->SetRestitution(static_cast<float>(pair.restitution));
  }
  w.filter.open = false;

  const double steps = std::ceil(std::max({1.0, dt / longestStep - 1e-6, longest / longestWay}));
  const auto step = static_cast<float>(dt / steps);
  for (int i = 0; i < static_cast<int>(steps); ++i) {
    // A contact lives while its boxes overlap: make them cover all that can be reached.
    for (const MovingBody& moving : bodies) {
      const b2FixtureProxy* proxy = w.proxies[moving.body];
      const float half = proxy->fixture->GetShape()->m_radius + units(moving.reach) + 0.1F;
      const b2Vec2 centre = w.bodies[moving.body]->GetPosition();
      b2AABB box;
      box.lowerBound = centre - b2Vec2(half, half);
      box.upperBound = centre + b2Vec2(half, half);
      w.manager().m_broadPhase.MoveProxy(proxy->proxyId, box, b2Vec2_zero);
    }
    w.world.Step(step, velocityIterations, positionIterations);
  }

  for (MovingBody& moving : bodies) {
    const b2Body* body = w.bodies[moving.body];
    const b2Vec2 before = units(moving.velocity.x, moving.velocity.y);
    b2Vec2 expected = units(moving.position.x, moving.position.y);
    const b2Vec2 start = expected;
    for (int i = 0; i < static_cast<int>(steps); ++i) expected += step * before;
    const b2Vec2 after = body->GetLinearVelocity();
    moving.deflected = !(after == before) || !(body->GetPosition() == expected);
    if (moving.deflected) {
      const b2Vec2 way = body->GetPosition() - start;
      moving.position.x += static_cast<double>(way.x) / unitsPerMetre;
      moving.position.y += static_cast<double>(way.y) / unitsPerMetre;
      moving.velocity = {static_cast<double>(after.x) / unitsPerMetre,
                         static_cast<double>(after.y) / unitsPerMetre};
    } else {
      moving.position.x += moving.velocity.x * dt;
      moving.position.y += moving.velocity.y * dt;
    }
    const b2Vec2& sum = w.impulses.sums[moving.body];
    moving.impulse = {static_cast<double>(sum.x) / unitsPerMetre,
                      static_cast<double>(sum.y) / unitsPerMetre};
  }
  w.clearContacts();
  for (const MovingBody& moving : bodies) w.bodies[moving.body]->SetAwake(false);
}

}  // namespace pitchboard::sim::rigid
