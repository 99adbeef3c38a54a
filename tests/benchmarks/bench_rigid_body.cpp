// SPDX-License-Identifier: GPL-3.0-or-later

// Ticks per second of the rigid-body model beside a bare Box2D world with the same bodies: robots
// that walk where their commands send them, ball, posts, walls and nets. Argument: robots.

#include <benchmark/benchmark.h>
#include <box2d/box2d.h>

#include <cmath>
#include <vector>

#include <simcore/simulation/simulation.h>

#include "rigid_body_obstacles.h"

namespace {

using namespace pitchboard;
using namespace pitchboard::sim;

constexpr int ticksPerAction = 120;
constexpr int actions[] = {1, 17, 8, 18, 6, 7};

Pose startOf(int robot) {
  return {{-4.0 + 1.3 * (robot % 7), -2.2 + 1.4 * (robot / 7)}, 0.7 * robot};
}

int actionOf(int robot, std::uint64_t tick) {
  return actions[(static_cast<std::uint64_t>(robot) + tick / ticksPerAction) % std::size(actions)];
}

Simulation makeSimulation(int robots, const NoiseParameters& noise) {
  SimulationSettings settings;
  settings.noise = noise;
  Simulation simulation = Simulation::create(settings).value();
  for (int i = 0; i < robots; ++i) {
    RobotIdentity identity;
    identity.id = {i + 1};
    identity.team = i % 2 == 0 ? TeamColor::Blue : TeamColor::Red;
    (void)simulation.addRobot(identity, startOf(i));
  }
  return simulation;
}

void run(benchmark::State& state, const NoiseParameters& noise) {
  const int robots = static_cast<int>(state.range(0));
  Simulation simulation = makeSimulation(robots, noise);
  (void)simulation.placeBall({0.35, 0.1}, {1.0, 0.5});
  std::vector<RobotCommand> commands(static_cast<std::size_t>(robots));
  std::vector<Percepts> percepts(commands.size());
  for (auto _ : state) {
    const std::uint64_t tick = simulation.state().tick;
    if (tick % ticksPerAction == 0) {
      for (int i = 0; i < robots; ++i) {
        auto& command = commands[static_cast<std::size_t>(i)];
        command.actionA = actionOf(i, tick);
        command.actionB = 10;
      }
      (void)simulation.placeBall(simulation.snapshot().ball, {1.0, 0.5});
    }
    simulation.step(commands, percepts);
    benchmark::DoNotOptimize(percepts.data());
  }
  state.SetItemsProcessed(state.iterations());
}

void rigidBody(benchmark::State& state) {
  run(state, {});
}

void rigidBodyRealisticNoise(benchmark::State& state) {
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
  run(state, noise);
}

void bareBox2D(benchmark::State& state) {
  const int robots = static_cast<int>(state.range(0));
  const FieldSpec field;
  b2World world(b2Vec2(0.0F, 0.0F));
  b2BodyDef groundDef;
  b2Body* ground = world.CreateBody(&groundDef);
  for (const rigid::Obstacle& o : rigid::obstaclesOf(field)) {
    if (o.first == o.last) {
      b2CircleShape shape;
      shape.m_p.Set(static_cast<float>(o.first.x), static_cast<float>(o.first.y));
      shape.m_radius = static_cast<float>(o.radius);
      ground->CreateFixture(&shape, 0.0F);
    } else {
      b2EdgeShape shape;
      shape.SetTwoSided({static_cast<float>(o.first.x), static_cast<float>(o.first.y)},
                        {static_cast<float>(o.last.x), static_cast<float>(o.last.y)});
      ground->CreateFixture(&shape, 0.0F);
    }
  }
  const auto addCircle = [&](const Point& place, double radius, bool bullet) {
    b2BodyDef def;
    def.type = b2_dynamicBody;
    def.position.Set(static_cast<float>(place.x), static_cast<float>(place.y));
    def.fixedRotation = true;
    def.bullet = bullet;
    b2Body* body = world.CreateBody(&def);
    b2CircleShape shape;
    shape.m_radius = static_cast<float>(radius);
    body->CreateFixture(&shape, 1.0F);
    return body;
  };
  std::vector<b2Body*> bodies;
  for (int i = 0; i < robots; ++i) {
    bodies.push_back(addCircle(startOf(i).position, field.robotRadius, false));
  }
  b2Body* ball = addCircle({0.35, 0.1}, field.ballRadius, true);
  ball->SetLinearDamping(3.0F);
  std::vector<b2Vec2> velocities(bodies.size());
  std::uint64_t tick = 0;
  for (auto _ : state) {
    if (tick % ticksPerAction == 0) {
      for (int i = 0; i < robots; ++i) {
        const int action = actionOf(i, tick);
        const double yaw = startOf(i).yaw + (action == 6 ? 1.57 : action == 7 ? -1.57 : 0.0);
        const double speed = action == 17 || action == 18 ? -0.15 : 0.15;
        velocities[static_cast<std::size_t>(i)].Set(static_cast<float>(speed * std::cos(yaw)),
                                                    static_cast<float>(speed * std::sin(yaw)));
      }
      ball->SetLinearVelocity({1.0F, 0.5F});
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) bodies[i]->SetLinearVelocity(velocities[i]);
    world.Step(1.0F / 60.0F, 8, 3);
    ++tick;
  }
  state.SetItemsProcessed(state.iterations());
}

BENCHMARK(bareBox2D)->Arg(1)->Arg(6)->Arg(22);
BENCHMARK(rigidBody)->Arg(1)->Arg(6)->Arg(22);
BENCHMARK(rigidBodyRealisticNoise)->Arg(1)->Arg(6)->Arg(22);

}  // namespace

BENCHMARK_MAIN();
