// SPDX-License-Identifier: GPL-3.0-or-later
#include "match_worlds.h"

#include <algorithm>

#include <base/try.h>

#include "world_columns.h"

namespace pitchboard::link {
namespace {

// Nobody reads the events of these matches; they are thrown away before their list is full.
constexpr int ticksBetweenForgetting = 200;

}  // namespace

Result<MatchWorlds::World> MatchWorlds::make(std::uint64_t seed) const {
  Scenario seeded = m_scenario;
  seeded.settings.seed = seed;
  World world{TRY(SimulatedMatch::create(seeded, m_options)), {}};
  world.finishedBy = world.match.finishedBy();
  return world;
}

Result<void> MatchWorlds::add(std::uint64_t seed) {
  m_worlds.push_back(TRY(make(seed)));
  for (const auto& slot : m_worlds.back().match.robots().all()) {
    m_boards.push_back(slot->board.view());
  }
  return {};
}

void MatchWorlds::findBoards(std::size_t world) {
  const auto& slots = m_worlds[world].match.robots().all();
  for (std::size_t i = 0; i < slots.size(); ++i) {
    m_boards[world * slots.size() + i] = slots[i]->board.view();
  }
}

Result<void> MatchWorlds::setBehaviour(RobotId robot, const std::string& behaviour) {
  for (World& world : m_worlds) TRY(world.match.robots().setBehaviour(robot, behaviour));
  for (ScenarioRobot& one : m_scenario.robots) {
    if (one.identity.id == robot) one.behaviour = behaviour;
  }
  return {};
}

void MatchWorlds::World::play(int ticks, std::vector<MatchEvent>& news) {
  for (int i = 0; i < ticks && finishedBy.empty(); ++i) {
    match.tick();
    sensed = true;
    finishedBy = match.finishedBy();
    if (++sinceForgot < ticksBetweenForgetting) continue;
    sinceForgot = 0;
    match.drainEvents(news);
    news.clear();
  }
}

void MatchWorlds::step(StepTeam& team, int ticks) {
  team.run(m_worlds.size(), static_cast<std::size_t>(ticks),
           [&](std::size_t /*worker*/, std::size_t first, std::size_t last) {
             std::vector<MatchEvent> news;
             for (std::size_t i = first; i < last; ++i) m_worlds[i].play(ticks, news);
           });
}

void MatchWorlds::readPercepts(std::span<double> out) const {
  columns::Filling filling{out.data()};
  for (const World& world : m_worlds) {
    for (const sim::Percepts& percepts : world.match.percepts()) {
      if (world.sensed) {
        columns::visitPercepts(percepts, filling);
      } else {
        filling.leaveOut(columnsOf(WorldArray::Percepts).size());
      }
    }
  }
}

Result<void> MatchWorlds::withSimulation(std::size_t world, const Use& use) {
  return use(m_worlds[world].match.simulation());
}

Result<void> MatchWorlds::reset(std::size_t world, std::uint64_t seed) {
  m_worlds[world] = TRY(make(seed));
  findBoards(world);
  return {};
}

WorldSnapshot MatchWorlds::snapshot(std::size_t world) {
  const SimulatedMatch& match = m_worlds[world].match;
  WorldSnapshot out;
  out.moment.state = match.simulation().state();
  out.finishedBy = m_worlds[world].finishedBy;
  for (const auto& slot : match.robots().all()) {
    out.moment.robots.push_back(saved(slot->id, slot->behaviour, slot->board));
  }
  return out;
}

Result<void> MatchWorlds::restore(std::size_t world, const WorldSnapshot& snapshot) {
  World& changed = m_worlds[world];
  TRY(checkSnapshot(snapshot, changed.match.simulation().state()));
  TRY(changed.match.restore(snapshot.moment));
  findBoards(world);
  changed.finishedBy = columns::finishReason(snapshot.finishedBy);
  changed.sensed = false;
  return {};
}

}  // namespace pitchboard::link
