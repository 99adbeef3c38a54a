// SPDX-License-Identifier: GPL-3.0-or-later
#include "rigid_body_contact_world.h"

#include <cstdint>
#include <mutex>

namespace pitchboard::sim::rigid {
namespace {

constexpr int velocityIterations = 8;
// Overlaps are the caller's to resolve, in double and smoothly.
constexpr int positionIterations = 0;

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

ContactWorld::Ground ContactWorld::groundOf(const SimulationSettings& settings) {
  const FieldSpec& f = settings.field;
  return {f.length,    f.width,          f.border,     f.goalWidth,
          f.goalDepth, f.goalPostRadius, f.ballRadius, settings.rigidBody.ballMass};
}

ContactWorld::Size ContactWorld::sizeOf(const WorldState& state, std::size_t robot) {
  return {robotRadius(state, robot), state.models[robot].mass};
}

bool ContactWorld::fits(const WorldState& state) const {
  if (m_robots != state.robots.size() || !(m_ground == groundOf(state.settings))) return false;
  for (std::size_t i = 0; i < m_robots; ++i) {
    if (!(m_sizes[i] == sizeOf(state, i))) return false;
  }
  return true;
}

ContactWorld::ContactWorld(const WorldState& state)
    : m_ground(groundOf(state.settings)),
      m_obstacles(obstaclesOf(state.settings.field)),
      m_robots(state.robots.size()) {
  for (std::size_t i = 0; i < m_robots; ++i) m_sizes.push_back(sizeOf(state, i));
  m_world.SetContactFilter(&m_filter);
  m_world.SetWarmStarting(false);
  m_world.SetAutoClearForces(false);  // there are none
  for (std::size_t i = 0; i <= m_robots; ++i) addBody(i);
  addObstacles();
  findProxies();
  m_listed.reserve(maxPairs(m_robots));
  m_wanted.reserve(maxPairs(m_robots));
  warmUp();
}

/// The world hands its contact manager out as constant; it is our own world all the same.
b2ContactManager& ContactWorld::manager() {
  return const_cast<b2ContactManager&>(m_world.GetContactManager());
}

void ContactWorld::addBody(std::size_t index) {
  const bool isBall = index == m_robots;
  b2BodyDef def;
  def.type = b2_dynamicBody;
  def.fixedRotation = true;
  def.bullet = isBall;
  def.awake = false;
  b2Body* body = m_world.CreateBody(&def);
  b2CircleShape shape;
  shape.m_radius = units(isBall ? m_ground.ballRadius : m_sizes[index].radius);
  const double mass = isBall ? m_ground.ballMass : m_sizes[index].mass;
  b2FixtureDef fixture;
  fixture.shape = &shape;
  fixture.density =
      static_cast<float>(mass / (static_cast<double>(b2_pi) * shape.m_radius * shape.m_radius));
  fixture.friction = 0.0F;
  fixture.userData.pointer = index;
  body->CreateFixture(&fixture);
  m_bodies.push_back(body);
}

void ContactWorld::addObstacles() {
  const b2BodyDef def;
  b2Body* standing = m_world.CreateBody(&def);
  for (std::size_t i = 0; i < m_obstacles.size(); ++i) {
    const Obstacle& o = m_obstacles[i];
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
    fixture.userData.pointer = m_robots + 1 + i;
    standing->CreateFixture(&fixture);
  }
}

void ContactWorld::findProxies() {
  m_proxies.resize(m_robots + 1 + obstacleCount);
  ProxyCollector collector(manager().m_broadPhase, m_proxies);
  b2AABB everywhere;
  everywhere.lowerBound.Set(-1e6F, -1e6F);
  everywhere.upperBound.Set(1e6F, 1e6F);
  manager().m_broadPhase.Query(&collector, everywhere);
}

/// Everything at one place and in contact once, so that Box2D's pools and buffers have the size
/// that they can ever need.
void ContactWorld::warmUp() {
  // Box2D registers its kinds of contact on first use, in a static table.
  static std::mutex registration;
  const std::lock_guard lock(registration);
  for (b2Body* one : m_bodies) one->SetTransform({0.0F, 0.0F}, 0.0F);
  m_world.Step(0.0F, velocityIterations, positionIterations);
  m_filter.open = true;
  for (std::size_t i = 0; i < m_bodies.size(); ++i) {
    for (std::size_t j = i + 1; j < m_bodies.size(); ++j) {
      manager().AddPair(m_proxies[i], m_proxies[j]);
    }
    for (std::size_t k = 0; k < obstacleCount; k += obstacleCount / 4) {
      manager().AddPair(m_proxies[i], m_proxies[m_robots + 1 + k]);
    }
  }
  m_filter.open = false;
  clearContacts();
  for (b2Body* one : m_bodies) one->SetAwake(false);
}

void ContactWorld::clearContacts() {
  while (manager().m_contactList) manager().Destroy(manager().m_contactList);
  m_listed.clear();
}

ContactWorld::Proxies ContactWorld::proxiesOf(std::span<const MovingBody> moving,
                                              const NearPair& pair) const {
  const std::size_t second = pair.obstacle ? m_robots + 1 + pair.second : moving[pair.second].body;
  return {m_proxies[moving[pair.first].body], m_proxies[second]};
}

double ContactWorld::touchingOf(std::span<const MovingBody> moving, const NearPair& pair) const {
  const auto [first, second] = proxiesOf(moving, pair);
  return static_cast<double>(first->fixture->GetShape()->m_radius) +
         static_cast<double>(second->fixture->GetShape()->m_radius);
}

void ContactWorld::place(const MovingBody& moving) {
  b2Body& one = body(moving);
  one.SetTransform(units(moving.position.x, moving.position.y), 0.0F);
  one.SetAwake(true);
  one.SetLinearVelocity(units(moving.velocity.x, moving.velocity.y));
}

void ContactWorld::list(std::span<const MovingBody> moving, std::span<const NearPair> pairs,
                        std::span<const std::size_t> chosen) {
  m_wanted.clear();
  for (const std::size_t k : chosen) m_wanted.push_back(proxiesOf(moving, pairs[k]));
  // Box2D destroys a contact whose boxes have parted.
  const bool stands =
      m_wanted == m_listed && static_cast<std::size_t>(manager().m_contactCount) == m_listed.size();
  if (!stands) {
    clearContacts();
    m_filter.open = true;
    for (const auto& [first, second] : m_wanted) manager().AddPair(first, second);
    m_filter.open = false;
    m_listed.swap(m_wanted);
  }
  // The newest contact is the first of the world's.
  b2Contact* contact = manager().m_contactList;
  for (auto k = chosen.rbegin(); k != chosen.rend(); ++k, contact = contact->GetNext()) {
    contact->SetRestitution(static_cast<float>(pairs[*k].restitution));
  }
}

void ContactWorld::spreadBox(const MovingBody& moving) {
  const b2FixtureProxy* proxy = m_proxies[moving.body];
  const float half = proxy->fixture->GetShape()->m_radius + units(moving.reach) + 0.1F;
  const b2Vec2 centre = body(moving).GetPosition();
  b2AABB box;
  box.lowerBound = centre - b2Vec2(half, half);
  box.upperBound = centre + b2Vec2(half, half);
  manager().m_broadPhase.MoveProxy(proxy->proxyId, box, b2Vec2_zero);
}

void ContactWorld::step(float dt, bool impacts) {
  m_world.SetContinuousPhysics(impacts);
  m_world.Step(dt, velocityIterations, positionIterations);
}

}  // namespace pitchboard::sim::rigid
