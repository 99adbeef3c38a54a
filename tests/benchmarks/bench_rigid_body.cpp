// SPDX-License-Identifier: GPL-3.0-or-later

// Ticks per second of the rigid-body model beside a bare Box2D world with the same bodies: robots
// that walk where their commands send them, ball, posts, walls and nets. Argument: robots. Spread
// out they never meet; in a heap all push towards the middle, and six of them make a scrum for the
// ball.
//
// A crowd does not last: robots that only push forward slip past each other, and after some
// thousand ticks the model's stand at the walls while those of the bare world are still in a heap.
// So both begin again, every few seconds, with the same robots at the same places, touching
// already. The counter `contacts` tells how many pairs touch in a tick; only with as many on both
// sides does the comparison say anything.

#include <benchmark/benchmark.h>
#include <box2d/box2d.h>

#include <cmath>
#include <utility>
#include <vector>

#include <simcore/simulation/simulation.h>

#include "rigid_body_obstacles.h"

namespace {

using namespace pitchboard;
using namespace pitchboard::sim;

constexpr int ticksPerAction = 120;
constexpr int actions[] = {1, 17, 8, 18, 6, 7};
constexpr int settlingTicks = 240;         // from the spiral until all push
constexpr std::uint64_t crowdTicks = 240;  // until a crowd begins again
constexpr double touching = 0.001;         // m

enum class Crowd { Spread, Heap };

Pose startOf(int robot, Crowd crowd) {
  if (crowd == Crowd::Spread) {
    return {{-4.0 + 1.3 * (robot % 7), -2.2 + 1.4 * (robot / 7)}, 0.7 * robot};
  }
  // On a spiral, close together and looking at the middle, where the ball is.
  const double angle = 2.4 * robot;
  const double away = 0.3 + 0.17 * std::sqrt(robot);
  return {{away * std::cos(angle), away * std::sin(angle)}, angle + 3.14159};
}

Velocity ballSpeedOf(Crowd crowd) {
  return crowd == Crowd::Spread ? Velocity{1.0, 0.5} : Velocity{};
}

int actionOf(int robot, std::uint64_t tick, Crowd crowd) {
  if (crowd == Crowd::Heap) return 1;
  return actions[(static_cast<std::uint64_t>(robot) + tick / ticksPerAction) % std::size(actions)];
}

bool beginsAgain(std::uint64_t tick, Crowd crowd) {
  return crowd == Crowd::Heap && tick % crowdTicks == 0;
}

/// Where everybody stands.
struct Places {
  std::vector<Pose> robots;
  Point ball;
};

/// Pairs of robots, of robots and the ball, and of either with posts, walls and nets.
int contactsOf(const Places& places, const FieldSpec& field) {
  const rigid::Obstacles obstacles = rigid::obstaclesOf(field);
  std::vector<std::pair<Point, double>> bodies{{places.ball, field.ballRadius}};
  for (const Pose& robot : places.robots) bodies.emplace_back(robot.position, field.robotRadius);
  int count = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto& [place, radius] = bodies[i];
    for (std::size_t j = 0; j < i; ++j) {
      const Point& other = bodies[j].first;
      const double distance = std::hypot(place.x - other.x, place.y - other.y);
      count += distance < radius + bodies[j].second + touching ? 1 : 0;
    }
    for (std::size_t k = 0; k < obstacles.size(); ++k) {
      const double distance = rigid::clearance(obstacles, k, place).distance;
      count += distance < radius + obstacles[k].radius + touching ? 1 : 0;
    }
  }
  return count;
}

/// Plays one crowd and tells how many pairs touched in a tick, as the benchmark's counter.
template <class Game>
void countContacts(benchmark::State& state, Game& game) {
  int contacts = 0;
  for (std::uint64_t i = 0; i < crowdTicks; ++i) {
    game.tick();
    contacts += contactsOf(game.places(), FieldSpec{});
  }
  state.counters["contacts"] = static_cast<double>(contacts) / static_cast<double>(crowdTicks);
}

/// Our model.
class ModelGame {
 public:
  ModelGame(const Places& begin, const NoiseParameters& noise, Crowd crowd)
      : m_begin(begin),
        m_crowd(crowd),
        m_simulation(make(noise)),
        m_commands(begin.robots.size()),
        m_percepts(begin.robots.size()) {
    for (std::size_t i = 0; i < begin.robots.size(); ++i) {
      RobotIdentity identity;
      identity.id = {static_cast<int>(i) + 1};
      identity.team = i % 2 == 0 ? TeamColor::Blue : TeamColor::Red;
      (void)m_simulation.addRobot(identity, begin.robots[i]);
      m_commands[i].actionB = 10;
    }
    (void)m_simulation.placeBall(begin.ball, {});
  }

  void tick() {
    const std::uint64_t tick = m_simulation.state().tick;
    if (beginsAgain(tick, m_crowd)) begin();
    if (tick % ticksPerAction == 0) {
      for (std::size_t i = 0; i < m_commands.size(); ++i) {
        m_commands[i].actionA = actionOf(static_cast<int>(i), tick, m_crowd);
      }
      (void)m_simulation.placeBall(m_simulation.snapshot().ball, ballSpeedOf(m_crowd));
    }
    m_simulation.step(m_commands, m_percepts);
    benchmark::DoNotOptimize(m_percepts.data());
  }

  Places places() const {
    const Snapshot now = m_simulation.snapshot();
    Places places{{}, now.ball};
    for (const RobotSnapshot& robot : now.robots) places.robots.push_back(robot.pose);
    return places;
  }

 private:
  static Simulation make(const NoiseParameters& noise) {
    SimulationSettings settings;
    settings.noise = noise;
    return Simulation::create(settings).value();
  }
  void begin() {
    for (std::size_t i = 0; i < m_begin.robots.size(); ++i) {
      (void)m_simulation.placeRobot({static_cast<int>(i) + 1}, m_begin.robots[i]);
    }
    (void)m_simulation.placeBall(m_begin.ball, {});
  }

  Places m_begin;
  Crowd m_crowd;
  Simulation m_simulation;
  std::vector<RobotCommand> m_commands;
  std::vector<Percepts> m_percepts;
};

/// Of a crowd: when all have reached it and push.
Places placesOf(int robots, Crowd crowd) {
  Places spiral{{}, crowd == Crowd::Spread ? Point{0.35, 0.1} : Point{}};
  for (int i = 0; i < robots; ++i) spiral.robots.push_back(startOf(i, crowd));
  if (crowd == Crowd::Spread) return spiral;
  ModelGame game(spiral, {}, crowd);
  for (int i = 0; i < settlingTicks; ++i) game.tick();
  return game.places();
}

void run(benchmark::State& state, const NoiseParameters& noise, Crowd crowd) {
  ModelGame game(placesOf(static_cast<int>(state.range(0)), crowd), noise, crowd);
  countContacts(state, game);
  for (auto _ : state) game.tick();
  state.SetItemsProcessed(state.iterations());
}

void rigidBody(benchmark::State& state) {
  run(state, {}, Crowd::Spread);
}
void rigidBodyHeap(benchmark::State& state) {
  run(state, {}, Crowd::Heap);
}

NoiseParameters realistic() {
  NoiseParameters noise;
  noise.forward = noise.sideways = 0.0005;
  noise.rotation = 0.002;
  noise.kickSpeed = 0.2;
  noise.kickAngle = 0.05;
  noise.visionDistance = 0.1;
  noise.visionBearing = 0.05;
  noise.robotDistance = 0.1;
  noise.robotBearing = 0.03;
  noise.landmarkBearing = 0.09;
  noise.landmarkProbability = 0.25;
  noise.missedDetection = 0.05;
  noise.visionDelay = 0.1;
  noise.imuWhite = 0.01;
  noise.imuDrift = 0.0005;
  return noise;
}

void rigidBodyRealisticNoise(benchmark::State& state) {
  run(state, realistic(), Crowd::Spread);
}
void rigidBodyHeapRealisticNoise(benchmark::State& state) {
  run(state, realistic(), Crowd::Heap);
}

/// Box2D as one uses it: the robots' velocities in, a step, everybody's place out.
class BareGame {
 public:
  BareGame(const Places& begin, Crowd crowd) : m_begin(begin), m_now(begin), m_crowd(crowd) {
    addObstacles();
    const RobotModel model;
    for (const Pose& robot : begin.robots) {
      m_robots.push_back(addCircle(robot.position, m_field.robotRadius, model.mass, false));
    }
    m_ball = addCircle(begin.ball, m_field.ballRadius, RigidBodySettings{}.ballMass, true);
    m_ball->SetLinearDamping(3.0F);
    m_velocities.resize(m_robots.size());
  }

  void tick() {
    if (beginsAgain(m_tick, m_crowd)) begin();
    if (m_tick % ticksPerAction == 0) {
      for (std::size_t i = 0; i < m_robots.size(); ++i) choose(i);
      const Velocity speed = ballSpeedOf(m_crowd);
      m_ball->SetLinearVelocity({static_cast<float>(speed.x), static_cast<float>(speed.y)});
    }
    for (std::size_t i = 0; i < m_robots.size(); ++i) {
      m_robots[i]->SetLinearVelocity(m_velocities[i]);
    }
    m_world.Step(1.0F / 60.0F, 8, 3);
    for (std::size_t i = 0; i < m_robots.size(); ++i) {
      m_now.robots[i].position = placeOf(*m_robots[i]);
    }
    m_now.ball = placeOf(*m_ball);
    benchmark::DoNotOptimize(m_now.robots.data());
    ++m_tick;
  }

  const Places& places() const { return m_now; }

 private:
  static b2Vec2 vector(const Point& place) {
    return {static_cast<float>(place.x), static_cast<float>(place.y)};
  }
  static Point placeOf(const b2Body& body) {
    return {static_cast<double>(body.GetPosition().x), static_cast<double>(body.GetPosition().y)};
  }

  void addObstacles() {
    const b2BodyDef def;
    b2Body* ground = m_world.CreateBody(&def);
    for (const rigid::Obstacle& o : rigid::obstaclesOf(m_field)) {
      if (o.first == o.last) {
        b2CircleShape shape;
        shape.m_p = vector(o.first);
        shape.m_radius = static_cast<float>(o.radius);
        ground->CreateFixture(&shape, 0.0F);
      } else {
        b2EdgeShape shape;
        shape.SetTwoSided(vector(o.first), vector(o.last));
        ground->CreateFixture(&shape, 0.0F);
      }
    }
  }

  b2Body* addCircle(const Point& place, double radius, double mass, bool bullet) {
    b2BodyDef def;
    def.type = b2_dynamicBody;
    def.position = vector(place);
    def.fixedRotation = true;
    def.bullet = bullet;
    b2Body* body = m_world.CreateBody(&def);
    b2CircleShape shape;
    shape.m_radius = static_cast<float>(radius);
    const double area = static_cast<double>(b2_pi) * radius * radius;
    body->CreateFixture(&shape, static_cast<float>(mass / area));
    return body;
  }

  void begin() {
    for (std::size_t i = 0; i < m_robots.size(); ++i) {
      m_robots[i]->SetTransform(vector(m_begin.robots[i].position), 0.0F);
    }
    m_ball->SetTransform(vector(m_begin.ball), 0.0F);
    m_ball->SetLinearVelocity(b2Vec2_zero);
  }

  void choose(std::size_t robot) {
    const int action = actionOf(static_cast<int>(robot), m_tick, m_crowd);
    const double yaw = m_begin.robots[robot].yaw;
    const GaitSpeed gait = gaitSpeed(RobotModel{}, action, 10);
    m_velocities[robot] = vector({gait.forward * std::cos(yaw) - gait.left * std::sin(yaw),
                                  gait.forward * std::sin(yaw) + gait.left * std::cos(yaw)});
  }

  const FieldSpec m_field;
  Places m_begin, m_now;
  Crowd m_crowd;
  b2World m_world{b2Vec2(0.0F, 0.0F)};
  std::vector<b2Body*> m_robots;
  b2Body* m_ball = nullptr;
  std::vector<b2Vec2> m_velocities;
  std::uint64_t m_tick = 0;
};

void bare(benchmark::State& state, Crowd crowd) {
  BareGame game(placesOf(static_cast<int>(state.range(0)), crowd), crowd);
  countContacts(state, game);
  for (auto _ : state) game.tick();
  state.SetItemsProcessed(state.iterations());
}

void bareBox2D(benchmark::State& state) {
  bare(state, Crowd::Spread);
}
void bareBox2DHeap(benchmark::State& state) {
  bare(state, Crowd::Heap);
}

BENCHMARK(bareBox2DHeap)->Arg(6)->Arg(22);
BENCHMARK(rigidBodyHeap)->Arg(6)->Arg(22);
BENCHMARK(rigidBodyHeapRealisticNoise)->Arg(6)->Arg(22);
BENCHMARK(bareBox2D)->Arg(1)->Arg(6)->Arg(22);
BENCHMARK(rigidBody)->Arg(1)->Arg(6)->Arg(22);
BENCHMARK(rigidBodyRealisticNoise)->Arg(1)->Arg(6)->Arg(22);

}  // namespace

BENCHMARK_MAIN();
