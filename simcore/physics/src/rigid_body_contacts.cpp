// SPDX-License-Identifier: GPL-3.0-or-later
#include "rigid_body_contacts.h"

#include <algorithm>
#include <cmath>

#include "rigid_body_contact_world.h"

namespace pitchboard::sim::rigid {
namespace {

constexpr double maxStep = 1.0 / 60.0;  // s; slower ticks are divided
// Box2D caps the way of one step at b2_maxTranslation; stay below.
constexpr double maxJump = 1.5 / unitsPerMetre;  // m
constexpr std::size_t maxWorlds = 4;             // kinds of matches in one thread, in turn

// Of distances in Box2D's units, on the side that asks Box2D: more than its rounding.
constexpr double doubt = 1e-3;

/// Box2D finds an impact where things are three slops, less a quarter of tolerance, nearer than
/// touching, or a slop and a quarter from each other; with another quarter of doubt.
double impactDistance(double touching) {
  constexpr double slop = static_cast<double>(b2_linearSlop);
  return std::max(touching - 2.5 * slop, 1.5 * slop);
}

}  // namespace

/// What a step needs beside the world: as scratch, for it is made again in every step.
struct ContactSolver::World : ContactWorld {
  explicit World(const WorldState& state) : ContactWorld(state) {
    chosen.reserve(maxPairs(robots()));
    touches.reserve(maxPairs(robots()));
    paths.reserve(robots() + 1);
    inside.reserve(robots() + 1);
  }

  /// In Box2D's units.
  struct Path {
    b2Vec2 from, to;
  };

  /// At least how far the way of a body stays away from an obstacle, its radius left out: posts are
  /// points, nets and walls run along an axis, and so each is a box.
  static double awayFrom(const Obstacle& o, const Path& path) {
    const auto gap = [](float from, float to, double first, double last) {
      const double low = static_cast<double>(std::min(from, to));
      const double high = static_cast<double>(std::max(from, to));
      return std::max(
          {0.0, static_cast<double>(units(first)) - high, low - static_cast<double>(units(last))});
    };
    return length(gap(path.from.x, path.to.x, o.first.x, o.last.x),
                  gap(path.from.y, path.to.y, o.first.y, o.last.y));
  }

  /// How near the middles of two bodies come to each other.
  static double awayFrom(const Path& one, const Path& other) {
    const b2Vec2 from = other.from - one.from, path = (other.to - one.to) - from;
    const double x = static_cast<double>(from.x), y = static_cast<double>(from.y);
    const double dx = static_cast<double>(path.x), dy = static_cast<double>(path.y);
    const double length2 = dx * dx + dy * dy;
    const double along = length2 > 0.0 ? std::clamp(-(x * dx + y * dy) / length2, 0.0, 1.0) : 0.0;
    return length(x + along * dx, y + along * dy);
  }

  double apart(const NearPair& pair) const {
    return pair.obstacle ? awayFrom(obstacles()[pair.second], paths[pair.first])
                         : awayFrom(paths[pair.first], paths[pair.second]);
  }

  bool isBall(const MovingBody& moving) const { return moving.body == robots(); }

  /// Box2D looks for impacts on what stands still, and for those of a bullet: the ball.
  bool looksForImpacts(std::span<const MovingBody> moving, const NearPair& pair) const {
    return pair.obstacle || isBall(moving[pair.second]);
  }

  /// Chooses the bodies that touch something as the step begins, with `impacts` also those that may
  /// hit something within it, and the pairs among them.
  void choose(std::span<const MovingBody> moving, std::span<const NearPair> pairs, bool impacts) {
    inside.assign(moving.size(), 0);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const NearPair& pair = pairs[k];
      if (!touches[k] && !(impacts && looksForImpacts(moving, pair))) continue;
      inside[pair.first] = 1;
      if (!pair.obstacle) inside[pair.second] = 1;
    }
    // Pairs that do not touch change nothing; with them the list stays the same for longer.
    chosen.clear();
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const NearPair& pair = pairs[k];
      if (inside[pair.first] && (pair.obstacle || inside[pair.second])) chosen.push_back(k);
    }
  }

  /// Steps what was chosen, from the beginning.
  void stepChosen(std::span<const MovingBody> moving, std::span<const NearPair> pairs, float dt,
                  int steps, bool impacts) {
    if (chosen.empty()) return;
    for (std::size_t i = 0; i < moving.size(); ++i) {
      if (inside[i]) place(moving[i]);
    }
    list(moving, pairs, chosen);
    for (int step = 0; step < steps; ++step) {
      for (std::size_t i = 0; impacts && i < moving.size(); ++i) {
        if (inside[i]) spreadBox(moving[i]);
      }
      ContactWorld::step(dt, impacts);
    }
  }

  /// One step: first without looking for impacts, and with it when the ways show that some are
  /// possible. A ball among many is nearly always pressed into one of them.
  void stepOnce(std::span<const MovingBody> moving, std::span<const NearPair> pairs, float dt) {
    constexpr int many = 3;
    paths.resize(moving.size());
    touches.resize(pairs.size());
    for (std::size_t i = 0; i < moving.size(); ++i) {
      const b2Vec2 from = units(moving[i].position.x, moving[i].position.y);
      paths[i] = {from, from};
    }
    const auto touch = [&](const NearPair& pair) {
      return apart(pair) <= touchingOf(moving, pair) + doubt;
    };
    const auto pressed = std::ranges::count_if(pairs, [&](const NearPair& pair) {
      return !pair.obstacle && isBall(moving[pair.second]) && touch(pair);
    });
    if (pressed >= many) return stepAll(moving, pairs, dt, 1);
    std::transform(pairs.begin(), pairs.end(), touches.begin(), touch);
    choose(moving, pairs, false);
    stepChosen(moving, pairs, dt, 1, false);
    for (std::size_t i = 0; i < moving.size(); ++i) {
      const MovingBody& one = moving[i];
      paths[i].to = inside[i] ? body(one).GetPosition()
                              : paths[i].from + dt * units(one.velocity.x, one.velocity.y);
    }
    const bool hits = std::ranges::any_of(pairs, [&](const NearPair& pair) {
      return looksForImpacts(moving, pair) &&
             apart(pair) <= impactDistance(touchingOf(moving, pair));
    });
    if (!hits) return;
    choose(moving, pairs, true);
    stepChosen(moving, pairs, dt, 1, true);
  }

  /// Every step with all pairs, looking for impacts.
  void stepAll(std::span<const MovingBody> moving, std::span<const NearPair> pairs, float dt,
               int steps) {
    touches.assign(pairs.size(), 1);
    choose(moving, pairs, true);
    stepChosen(moving, pairs, dt, steps, true);
  }

  std::vector<std::size_t> chosen;  // of the pairs
  std::vector<char> touches;        // of the pairs, as the step begins
  std::vector<Path> paths;          // of the bodies
  std::vector<char> inside;         // of the bodies: whether Box2D moves them
};

ContactSolver::ContactSolver() = default;
ContactSolver::~ContactSolver() = default;

void ContactSolver::prepare(const WorldState& world) {
  const auto fits = [&world](const auto& one) { return one->fits(world); };
  const auto found = std::ranges::find_if(m_worlds, fits);
  if (found == m_worlds.begin() && found != m_worlds.end()) return;
  if (found != m_worlds.end()) {
    std::rotate(m_worlds.begin(), found, found + 1);
    return;
  }
  if (m_worlds.size() == maxWorlds) m_worlds.pop_back();
  m_worlds.insert(m_worlds.begin(), std::make_unique<World>(world));
}

const Obstacles& ContactSolver::obstacles() const {
  return m_worlds.front()->obstacles();
}

void ContactSolver::solve(std::span<MovingBody> bodies, std::span<const NearPair> pairs,
                          double dt) {
  World& w = *m_worlds.front();
  double longest = 0.0;
  for (const MovingBody& moving : bodies) longest = std::max(longest, moving.reach);
  const double steps = std::ceil(std::max({1.0, dt / maxStep - 1e-6, longest / maxJump}));
  const auto step = static_cast<float>(dt / steps);
  if (steps > 1.0) {
    w.stepAll(bodies, pairs, step, static_cast<int>(steps));
  } else {
    w.stepOnce(bodies, pairs, step);
  }

  for (std::size_t i = 0; i < bodies.size(); ++i) {
    MovingBody& moving = bodies[i];
    b2Body& body = w.body(moving);
    const b2Vec2 before = units(moving.velocity.x, moving.velocity.y);
    const b2Vec2 start = units(moving.position.x, moving.position.y);
    b2Vec2 expected = start;
    for (int k = 0; k < static_cast<int>(steps); ++k) expected += step * before;
    const b2Vec2 after = body.GetLinearVelocity();
    moving.deflected = w.inside[i] && (!(after == before) || !(body.GetPosition() == expected));
    if (moving.deflected) {
      const b2Vec2 path = body.GetPosition() - start;
      moving.position.x += static_cast<double>(path.x) / unitsPerMetre;
      moving.position.y += static_cast<double>(path.y) / unitsPerMetre;
      moving.velocity = {static_cast<double>(after.x) / unitsPerMetre,
                         static_cast<double>(after.y) / unitsPerMetre};
    } else {
      moving.position.x += moving.velocity.x * dt;
      moving.position.y += moving.velocity.y * dt;
    }
    if (w.inside[i]) body.SetAwake(false);
  }
}

}  // namespace pitchboard::sim::rigid
