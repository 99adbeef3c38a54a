// SPDX-License-Identifier: GPL-3.0-or-later
#include "match_roster.h"

#include <utility>

#include <ui/base/robot_words.h>

namespace pitchboard::ui {

const link::ScenarioRobot* MatchRoster::robot(RobotId id) const {
  const auto found = m_robots.find(id);
  return found != m_robots.end() ? &found->second : nullptr;
}

void MatchRoster::begin(const link::Scenario& scenario) {
  m_robots.clear();
  for (const link::ScenarioRobot& entry : scenario.robots) {
    m_robots.emplace(entry.identity.id, entry);
  }
  takePhysics(scenario.settings.physics);
}

void MatchRoster::adopt(const link::Moment& moment) {
  Robots robots;
  for (std::size_t i = 0; i < moment.state.robots.size(); ++i) {
    const sim::RobotIdentity& identity = moment.state.robots[i];
    link::ScenarioRobot entry;
    if (const link::ScenarioRobot* known = robot(identity.id)) entry = *known;
    entry.identity = identity;
    entry.model = moment.state.models[i];
    if (const link::MomentRobot* of = moment.robot(identity.id)) entry.behaviour = of->behaviour;
    robots.emplace(identity.id, entry);
  }
  m_robots = std::move(robots);
  takePhysics(moment.state.settings.physics);
}

void MatchRoster::insert(const link::ScenarioRobot& entry) {
  m_robots.insert_or_assign(entry.identity.id, entry);
  m_match->post({QStringLiteral("%1 cannot be added").arg(robotName(entry.identity)),
                 [entry](link::SimulatedMatch& match) { return match.addRobot(entry); },
                 [this, id = entry.identity.id] { m_robots.erase(id); }});
}

void MatchRoster::erase(RobotId id) {
  const link::ScenarioRobot* known = robot(id);
  const QString name = known ? robotName(known->identity) : QStringLiteral("The robot");
  m_robots.erase(id);
  m_match->post({QStringLiteral("%1 cannot be removed").arg(name),
                 [id](link::SimulatedMatch& match) { return match.removeRobot(id); }});
}

void MatchRoster::changeIdentities(const std::vector<sim::RobotIdentity>& identities) {
  for (const sim::RobotIdentity& identity : identities) {
    const auto known = m_robots.find(identity.id);
    if (known == m_robots.end()) continue;
    const sim::RobotIdentity before = std::exchange(known->second.identity, identity);
    m_match->post({QStringLiteral("%1 stays in its team").arg(robotName(before)),
                   [identity](link::SimulatedMatch& match) { return match.setIdentity(identity); },
                   [this, before] {
                     const auto still = m_robots.find(before.id);
                     if (still != m_robots.end()) still->second.identity = before;
                   }});
  }
}

void MatchRoster::setBehaviour(RobotId id, const std::string& behaviour) {
  const auto known = m_robots.find(id);
  if (known == m_robots.end()) return;
  known->second.behaviour = behaviour;
  m_match->post(
      {QStringLiteral("%1 keeps its behaviour").arg(robotName(known->second.identity)),
       [id, behaviour](link::SimulatedMatch& match) { return match.setBehaviour(id, behaviour); }});
}

void MatchRoster::setRuntime(RobotId id, const link::RuntimeChoice& choice) {
  const auto known = m_robots.find(id);
  if (known == m_robots.end()) return;
  const link::RuntimeChoice before = std::exchange(known->second.runtime, choice);
  m_match->post({QStringLiteral("%1 keeps who runs for it").arg(robotName(known->second.identity)),
                 [id, choice](link::SimulatedMatch& match) { return match.setRuntime(id, choice); },
                 [this, id, before] {
                   const auto still = m_robots.find(id);
                   if (still != m_robots.end()) still->second.runtime = before;
                 }});
}

void MatchRoster::place(const std::vector<RobotPlacement>& placements, bool back) {
  m_match->post([placements, back](link::SimulatedMatch& match) {
    // A robot that left meanwhile has nothing to be placed.
    for (const RobotPlacement& placement : placements) {
      (void)match.simulation().placeRobot(placement.id, back ? placement.from : placement.to);
    }
  });
}

void MatchRoster::placeBall(Point position, Velocity velocity) {
  m_match->post({QStringLiteral("The ball cannot be placed"),
                 [position, velocity](link::SimulatedMatch& match) {
                   return match.simulation().placeBall(position, velocity);
                 }});
}

void MatchRoster::takePhysics(const std::string& name) {
  if (std::exchange(m_physics, name) != name && m_physicsChanged) m_physicsChanged();
}

void MatchRoster::setPhysics(const std::string& name) {
  const std::string before = m_physics;
  takePhysics(name);
  m_match->post(
      {QStringLiteral("Could not change the physics model"),
       [name](link::SimulatedMatch& match) { return match.simulation().setPhysics(name); },
       [this, before] { takePhysics(before); }});
}

void MatchRoster::setModels(const std::vector<std::pair<RobotId, sim::RobotModel>>& models) {
  for (const auto& [id, model] : models) {
    const auto known = m_robots.find(id);
    if (known == m_robots.end()) continue;
    known->second.model = model;
    m_match->post(
        {QStringLiteral("%1 stays the robot it was").arg(robotName(known->second.identity)),
         [id = id, model = model](link::SimulatedMatch& match) {
           return match.setRobotModel(id, model);
         }});
  }
  if (m_modelsChanged) m_modelsChanged();
}

}  // namespace pitchboard::ui
