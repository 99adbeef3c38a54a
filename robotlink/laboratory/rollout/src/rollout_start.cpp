// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/rollout/rollout_start.h>

#include <robotlink/cognition/process_registry.h>

namespace pitchboard::link {

RolloutStart rolloutStartOf(const Scenario& scenario, double tickRate) {
  RolloutStart start;
  start.setup.field = scenario.settings.field;
  start.setup.body = scenario.settings.rigidBody;
  start.setup.noise = scenario.settings.noise;
  start.setup.tickRate = tickRate;
  for (const ScenarioRobot& robot : scenario.robots) {
    rollout::Player player;
    player.side = robot.identity.imuStartsAt180 ? rollout::Side::Right : rollout::Side::Left;
    const BehaviourInfo* behaviour = findBehaviour(robot.behaviour);
    const bool plays = behaviour != nullptr && behaviour->usesPose;
    player.behaviour = {plays ? robot.behaviour : "idle", robot.parameters};
    player.model = robot.model;
    start.setup.players.push_back(std::move(player));
    rollout::RobotBelief belief;
    belief.pose = robot.pose;
    start.belief.robots.push_back(belief);
  }
  start.belief.ball.place = scenario.ball;
  start.belief.ball.velocity = scenario.ballVelocity;
  return start;
}

}  // namespace pitchboard::link
