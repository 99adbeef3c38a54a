// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plays a match of the reference robots in lock-step and measures it: goals, time in which robots
// touch, how far their belief is from the truth. Shared by tests.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <base/angles.h>
#include <robotlink/match/simulated_match.h>
#include <simcore/world/published_frame.h>

namespace pitchboard::link {

struct MatchMeasure {
  int left = 0, right = 0;  ///< goals
  double firstGoal = -1.0;  ///< s, -1 = none
  int kicks = 0, ballOut = 0;
  double walked = 0.0;                ///< m, all robots
  double touchShare = 0.0;            ///< of robots x time in which a robot touches another
  int collisions = 0;                 ///< times two robots came to touch
  std::vector<double> positionError;  ///< m, once a second and robot
  std::vector<double> yawError;       ///< rad
  std::uint64_t hash = 0;
};

inline double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0.0;
  const auto at = static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

/// match-3v3 with a striker, a supporter and a keeper in each team.
inline Result<Scenario> soccerMatch(const std::string& noise, std::uint64_t seed) {
  auto scenario = loadScenario("match-3v3");
  if (!scenario) return scenario;
  const auto parameters = noisePreset(noise);
  if (!parameters) return tl::unexpected<Error>(parameters.error());
  scenario->settings.noise = *parameters;
  scenario->settings.seed = seed;
  const char* const roles[] = {"striker", "keeper", "supporter"};
  for (std::size_t i = 0; i < scenario->robots.size(); ++i)
    scenario->robots[i].behaviour = roles[i % 3];
  return scenario;
}

inline double poseError(const SimulatedMatch& match, const sim::RobotSnapshot& robot, double* yaw) {
  const Blackboard& board = *match.blackboard(robot.identity.id);
  const RobotVariables& v = match.variables();
  const Pose belief = sim::published_frame::studioFromLocalization(
      match.simulation().state().settings.field,
      {static_cast<double>(board.read(v.localizationX)),
       static_cast<double>(board.read(v.localizationY)),
       static_cast<double>(board.read(v.localizationTheta))});
  if (yaw) *yaw = std::abs(wrapToPi(belief.yaw - robot.pose.yaw));
  return distance(belief.position, robot.pose.position);
}

/// `seconds` of simulated time.
inline MatchMeasure playMatch(SimulatedMatch& match, double seconds) {
  MatchMeasure measure;
  sim::Snapshot now;
  const double rate = match.simulation().state().settings.tickRate;
  const auto ticks = static_cast<int>(seconds * rate);
  const auto second = static_cast<int>(rate);
  const auto radius = [&match](std::size_t robot) {
    return sim::robotRadius(match.simulation().state(), robot);
  };
  long long touching = 0, samples = 0;
  std::vector<char> touched(64 * 64, 0);
  for (int t = 1; t <= ticks; ++t) {
    match.tick();
    for (const sim::Event& event : match.simulation().events()) {
      measure.kicks += event.kind == sim::EventKind::Kick;
      measure.ballOut += event.kind == sim::EventKind::BallOut;
      if (event.kind == sim::EventKind::Goal && measure.firstGoal < 0) measure.firstGoal = t / rate;
    }
    if (t % 6 != 0) continue;
    match.simulation().snapshot(now);
    const std::size_t n = now.robots.size();
    for (std::size_t i = 0; i < n; ++i) {
      bool any = false;
      for (std::size_t j = 0; j < n; ++j) {
        if (i == j) continue;
        const Point a = now.robots[i].pose.position, b = now.robots[j].pose.position;
        const bool contact = distance(a, b) < radius(i) + radius(j) + 0.005;
        any = any || contact;
        char& before = touched[i * 64 + j];
        measure.collisions += contact && !before && i < j;
        before = contact;
      }
      touching += any;
      ++samples;
      if (t % second == 0 && t > 20 * second) {
        double yaw = 0.0;
        measure.positionError.push_back(poseError(match, now.robots[i], &yaw));
        measure.yawError.push_back(yaw);
      }
    }
  }
  match.simulation().snapshot(now);
  for (const auto& robot : now.robots) measure.walked += robot.statistics.distanceWalked;
  measure.left = now.score.left;
  measure.right = now.score.right;
  measure.touchShare = samples ? static_cast<double>(touching) / static_cast<double>(samples) : 0.0;
  measure.hash = match.simulation().hash();
  return measure;
}

}  // namespace pitchboard::link
