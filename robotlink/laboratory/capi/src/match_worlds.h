// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Worlds that are matches: those with robots that our behaviours play, with a referee, or with
// blackboard values that the scenario writes later. A new beginning is a new match.

#include <string_view>
#include <vector>

#include "world_group.h"

namespace pitchboard::link {

class MatchWorlds final : public WorldGroup {
 public:
  MatchWorlds(const Scenario& scenario, const MatchOptions& options)
      : m_scenario(scenario), m_options(options) {}
  /// Adds a world.
  Result<void> add(std::uint64_t seed);
  Result<void> setBehaviour(RobotId robot, const std::string& behaviour);

  std::size_t count() const { return m_worlds.size(); }
  const SimulatedMatch& match(std::size_t world) const { return m_worlds[world].match; }
  /// Whether the world has been stepped since its beginning or a snapshot.
  bool sensed(std::size_t world) const { return m_worlds[world].sensed; }

  void step(StepTeam& team, int ticks) override;
  std::string_view finishedBy(std::size_t world) const override {
    return m_worlds[world].finishedBy;
  }
  void readPercepts(std::span<double> out) const override;
  Result<void> withSimulation(std::size_t world, const Use& use) override;
  Result<void> reset(std::size_t world, std::uint64_t seed) override;
  WorldSnapshot snapshot(std::size_t world) override;
  Result<void> restore(std::size_t world, const WorldSnapshot& snapshot) override;

 private:
  struct World {
    SimulatedMatch match;
    std::string_view finishedBy;
    bool sensed = false;
    int sinceForgot = 0;  // ticks

    void play(int ticks, std::vector<MatchEvent>& news);
  };

  Result<World> make(std::uint64_t seed) const;
  void findBoards(std::size_t world);

  Scenario m_scenario;
  MatchOptions m_options;
  std::vector<World> m_worlds;
};

}  // namespace pitchboard::link
