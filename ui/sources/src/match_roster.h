// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The robots of the match as a person's edits know them, present or about to be, and the orders
// that bring them in, move and remove them: what undoable commands are made of. Belongs to
// MatchEdits. UI thread only.

#include <map>
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
  /// Another match, with these.
  void begin(const std::vector<link::ScenarioRobot>& robots);
  /// The same match at another moment.
  void adopt(const link::Moment& moment);

  void insert(const link::ScenarioRobot& robot);
  void erase(RobotId id);
  void changeIdentities(const std::vector<sim::RobotIdentity>& identities);
  /// Does nothing for a robot that is not there.
  void setBehaviour(RobotId id, const std::string& behaviour);
  void setRuntime(RobotId id, const link::RuntimeChoice& choice);
  void place(const std::vector<RobotPlacement>& placements, bool back);
  void placeBall(Point position);

 private:
  MatchController* m_match;
  Robots m_robots;
};

}  // namespace pitchboard::ui
