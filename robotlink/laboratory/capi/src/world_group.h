// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// All worlds that are stepped together, in one of two forms: as matches (MatchWorlds), or, if the
// caller controls all robots, as little more than what ticks change (SteeredWorlds). Both give the
// same results. What differs between them happens once for a world, never for each robot. Used by
// the thread of Worlds, which owns it.

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include <robotlink/capi/worlds.h>

#include "step_team.h"

namespace pitchboard::link {

class WorldGroup {
 public:
  /// Where each word of a blackboard stands.
  using WordPlaces = std::array<int, Blackboard::words>;

  virtual ~WorldGroup() = default;
  WorldGroup(const WorldGroup&) = delete;
  WorldGroup& operator=(const WorldGroup&) = delete;

  /// Advances all worlds, each until its scenario has ended.
  virtual void step(StepTeam& team, int ticks) = 0;
  /// Why the scenario of a world is over; empty while it goes on.
  virtual std::string_view finishedBy(std::size_t world) const = 0;
  /// Fills the rows of all robots in all worlds.
  virtual void readPercepts(std::span<double> out) const = 0;
  /// Calls use() with a world, to read or change it.
  using Use = std::function<Result<void>(sim::Simulation&)>;
  virtual Result<void> withSimulation(std::size_t world, const Use& use) = 0;
  virtual Result<void> reset(std::size_t world, std::uint64_t seed) = 0;
  virtual WorldSnapshot snapshot(std::size_t world) = 0;
  virtual Result<void> restore(std::size_t world, const WorldSnapshot& snapshot) = 0;

  /// The blackboards of all worlds, robot by robot. Their words may stand in another order:
  /// placed() says where.
  std::vector<Blackboard>& boards() { return m_boards; }
  const std::vector<Blackboard>& boards() const { return m_boards; }
  IntVar placed(IntVar variable) const {
    return {m_places[static_cast<std::size_t>(variable.index)]};
  }
  FloatVar placed(FloatVar variable) const {
    return {placed(IntVar{Blackboard::floatOffset + variable.index}).index -
            Blackboard::floatOffset};
  }
  std::vector<Variable> placed(std::span<const Variable> variables) const;

 protected:
  WorldGroup();
  /// What is saved of a robot.
  MomentRobot saved(RobotId id, const std::string& behaviour, const Blackboard& board) const;
  /// Fails unless `snapshot` is of a world of the same scenario as `mine`.
  static Result<void> checkSnapshot(const WorldSnapshot& snapshot, const sim::WorldState& mine);

  std::vector<Blackboard> m_boards;
  WordPlaces m_places{};
};

}  // namespace pitchboard::link
