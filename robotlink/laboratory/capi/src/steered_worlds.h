// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Worlds in which the caller controls all robots. Of each only what ticks change is kept: its
// course, its blackboards, and the percepts of the last tick. They stand next to each other in
// memory, and each thread plays its worlds in turn with one simulation, which has the field, the
// settings and the models of the robots. So a tick touches few cache lines of a world, and none of
// them is far from the next.

#include <optional>
#include <string_view>
#include <vector>

#include <robotlink/match/blackboard_bridge.h>
#include <robotlink/match/match_end.h>

#include "match_worlds.h"

namespace pitchboard::link {

class SteeredWorlds final : public WorldGroup {
 public:
  /// Returns the worlds of this scenario, all at its beginning, with these seeds; null unless they
  /// remember nothing but their course and their blackboards.
  static Result<std::unique_ptr<SteeredWorlds>> create(const Scenario& scenario,
                                                       const MatchOptions& options,
                                                       std::size_t count, std::size_t workers);
  /// Continues worlds that were matches. Their robots have no behaviours any more.
  Result<void> take(MatchWorlds& matches);
  /// Whether the robots of this moment have no behaviours either.
  static bool canRestore(const WorldSnapshot& snapshot);

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
    sim::WorldCourse course;
    MatchEnd end;
    bool sensed = false;  ///< it has been stepped since its beginning or a snapshot
    std::string_view finishedBy;
  };
  /// What a thread plays worlds with.
  struct Stage {
    explicit Stage(sim::Simulation made);
    sim::Simulation simulation;
    std::vector<sim::RobotCommand> commands;
    std::vector<sim::Percepts> percepts;
    std::vector<std::size_t> playing;      ///< worlds that play the next tick
    std::vector<RandomBatch::Tick> ticks;  ///< what these ticks are
  };

  SteeredWorlds(const Scenario& scenario, WorldSnapshot beginning, std::size_t count);
  void begin(std::size_t world, const WorldSnapshot& moment);
  void tick(Stage& stage, std::size_t world, bool keeps);
  void play(Stage& stage, std::size_t first, std::size_t last, int ticks);
  void keepPercepts(std::size_t world, std::span<const sim::Percepts> percepts);
  std::span<Blackboard> boardsOf(std::size_t world) {
    return std::span(m_boards).subspan(world * m_robots, m_robots);
  }

  StopConditions m_stop;
  WorldSnapshot m_beginning;
  std::size_t m_robots;
  std::optional<BlackboardBridge> m_bridge;  // knows where words stand
  std::vector<Stage> m_stages;               // one for each thread
  std::vector<World> m_worlds;
  std::vector<std::uint32_t> m_words;  // of all blackboards
  std::vector<double> m_percepts;      // rows, without columns of robots that are not there
  std::size_t m_row;                   // their length
};

}  // namespace pitchboard::link
