// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The robots and the physics of the match as a person's edits know them, present or about to be,
// and the orders that change them: what undoable commands are made of. Belongs to MatchEdits. UI
// thread only.

#include <functional>
#include <map>
#include <utility>
#include <vector>

#include <ui/sources/match_edits.h>

namespace pitchboard::ui {

class MatchRoster {
 public:
  using Robots = std::map<RobotId, link::ScenarioRobot>;

  explicit MatchRoster(MatchController* match) : m_match(match) {}

  const Robots& robots() const { return m_robots; }
  /// Null when it is not there.
  const link::ScenarioRobot* robot(RobotId id) const;
  const std::string& physics() const { return m_physics; }
  /// Another match, which begins like this.
  void begin(const link::Scenario& scenario);
  /// The same match at another moment.
  void adopt(const link::Moment& moment);

  void insert(const link::ScenarioRobot& robot);
  void erase(RobotId id);
  void changeIdentities(const std::vector<sim::RobotIdentity>& identities);
  /// Does nothing for a robot that is not there.
  void setBehaviour(RobotId id, const std::string& behaviour);
  void setRuntime(RobotId id, const link::RuntimeChoice& choice);
  void place(const std::vector<RobotPlacement>& placements, bool back);
  void placeBall(Point position, Velocity velocity = {});
  /// Does nothing for robots that are not there.
  void setModels(const std::vector<std::pair<RobotId, sim::RobotModel>>& models);
  void setPhysics(const std::string& name);
  /// Called whenever a robot became another kind of robot.
  void whenModelsChange(std::function<void()> tell) { m_modelsChanged = std::move(tell); }
  void whenPhysicsChanges(std::function<void()> tell) { m_physicsChanged = std::move(tell); }

 private:
  void takePhysics(const std::string& name);

  MatchController* m_match;
  Robots m_robots;
  std::string m_physics;
  std::function<void()> m_modelsChanged, m_physicsChanged;
};

}  // namespace pitchboard::ui
