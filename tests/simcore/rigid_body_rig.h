// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A rigid-body simulation with its robots' commands and percepts, for tests. Metres, radians.

#include <cmath>
#include <numbers>
#include <vector>

#include <simcore/simulation/simulation.h>

namespace rig {

using namespace pitchboard;
using namespace pitchboard::sim;

inline constexpr double pi = std::numbers::pi;
inline constexpr double degree = pi / 180.0;

struct Rig {
  explicit Rig(const SimulationSettings& settings = {})
      : simulation(Simulation::create(settings).value()) {}

  std::size_t add(const Pose& pose, int id = 0, TeamColor team = TeamColor::Blue,
                  bool imuStartsAt180 = false) {
    RobotIdentity identity;
    identity.id = {id > 0 ? id : static_cast<int>(commands.size()) + 1};
    identity.team = team;
    identity.imuStartsAt180 = imuStartsAt180;
    const auto added = simulation.addRobot(identity, pose);
    if (!added) qFatal("%s", added.error().text().c_str());
    commands.emplace_back().searchOn = 0;
    percepts.emplace_back();
    return commands.size() - 1;
  }
  void step(int ticks = 1) {
    for (int i = 0; i < ticks; ++i) simulation.step(commands, percepts);
  }
  void run(double seconds) {
    step(static_cast<int>(std::lround(seconds * simulation.state().settings.tickRate)));
  }
  const RigidBodyState& state() const {
    return std::get<RigidBodyState>(simulation.state().physics);
  }
  const RigidRobot& robot(std::size_t index = 0) const { return state().robots[index]; }
  const RigidBall& ball() const { return state().ball; }
  void placeBall(double x, double y, double vx = 0.0, double vy = 0.0) {
    (void)simulation.placeBall({x, y}, {vx, vy});
  }
  void place(int id, const Pose& pose) { (void)simulation.placeRobot({id}, pose); }

  Simulation simulation;
  std::vector<RobotCommand> commands;
  std::vector<Percepts> percepts;
};

inline SimulationSettings atRate(double rate) {
  SimulationSettings settings;
  settings.tickRate = rate;
  return settings;
}

/// How deep any two things overlap, m; negative when all are apart.
inline double deepestOverlap(const Rig& r) {
  const FieldSpec& f = r.simulation.state().settings.field;
  struct Circle {
    Point centre;
    double radius;
  };
  std::vector<Circle> circles;
  for (const RigidRobot& robot : r.state().robots) {
    circles.push_back({robot.pose.position, f.robotRadius});
  }
  circles.push_back({r.ball().position, f.ballRadius});
  double deepest = -1.0;
  const double lineX = f.halfLength();
  const double post = f.goalWidth / 2;
  for (std::size_t i = 0; i < circles.size(); ++i) {
    const auto& [p, radius] = circles[i];
    for (std::size_t j = 0; j < i; ++j) {
      deepest =
          std::max(deepest, radius + circles[j].radius -
                                std::hypot(p.x - circles[j].centre.x, p.y - circles[j].centre.y));
    }
    for (const double x : {-lineX, lineX}) {
      for (const double y : {-post, post}) {
        deepest = std::max(deepest, radius + f.goalPostRadius - std::hypot(p.x - x, p.y - y));
        if (std::abs(p.x) > lineX) deepest = std::max(deepest, radius - std::abs(p.y - y));
      }
    }
    deepest = std::max(deepest, std::abs(p.x) + radius - lineX - f.border);
    deepest = std::max(deepest, std::abs(p.y) + radius - f.halfWidth() - f.border);
  }
  return deepest;
}

}  // namespace rig
