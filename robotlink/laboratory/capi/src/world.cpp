// SPDX-License-Identifier: GPL-3.0-or-later
#include "world.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>

#include <base/try.h>

#include "world_columns.h"

namespace pitchboard::link {
namespace {

// Nobody reads the events of these matches; they are thrown away before their list is full.
constexpr int ticksBetweenForgetting = 200;

constexpr std::uintptr_t cacheLine = 64;

/// Both ends lie in one object: between two objects may be all of the memory.
/// Returns how many cache lines they are.
std::size_t fetch(const void* begin, const void* end) {
  std::size_t lines = 0;
  const auto last = reinterpret_cast<std::uintptr_t>(end);
  auto line = reinterpret_cast<std::uintptr_t>(begin) / cacheLine * cacheLine;
  for (; line < last; line += cacheLine, ++lines) {
    __builtin_prefetch(reinterpret_cast<const void*>(line), 1);
  }
  return lines;
}

template <class Object>
std::size_t fetchObject(const Object& object) {
  return fetch(&object, &object + 1);
}

/// One variable in each cache line of a blackboard that the bridge reads or writes in a tick.
std::vector<IntVar> boardLines() {
  const RobotVariables v;
  const IntVar ints[] = {v.decisionActionA,
                         v.decisionActionB,
                         v.decisionSearchOn,
                         v.imuReset,
                         v.decisionActionVision,
                         v.decisionLocalization,
                         v.imuState,
                         v.controlAction,
                         v.controlMoving,
                         v.voltage,
                         v.visionLost,
                         v.controlWorking,
                         v.visionWorking,
                         v.imuWorking};
  const FloatVar floats[] = {v.imuEulerX,     v.imuEulerY,      v.imuEulerZ,       v.imuGyroX,
                             v.imuGyroY,      v.imuGyroZ,       v.imuAccelX,       v.imuAccelY,
                             v.imuAccelZ,     v.visionBallDist, v.visionBallAngle, v.visionPanDeg,
                             v.visionTiltDeg, v.landmarkDeg[0], v.landmarkDeg[3]};
  constexpr int wordsPerLine = cacheLine / sizeof(std::uint32_t);
  std::set<int> lines;
  for (const IntVar variable : ints) lines.insert(variable.index / wordsPerLine);
  for (const FloatVar variable : floats) {
    lines.insert((Blackboard::floatOffset + variable.index) / wordsPerLine);
  }
  std::vector<IntVar> first;
  for (const int line : lines) first.push_back(IntVar{line * wordsPerLine});
  return first;
}

template <class Values>
void fetchAll(const Values& values) {
  fetch(values.data(), values.data() + values.size());
}

}  // namespace

World::World(SimulatedMatch match) : m_match(std::move(match)) {
  findBoards();
}

void World::findBoards() {
  m_boards.clear();
  for (const sim::RobotIdentity& robot : m_match.simulation().state().robots) {
    m_boards.push_back(m_match.blackboard(robot.id));
  }
}

Result<World> World::create(const Scenario& scenario, const MatchOptions& options,
                            std::uint64_t seed) {
  Scenario seeded = scenario;
  seeded.settings.seed = seed;
  auto match = TRY(SimulatedMatch::create(seeded, options));
  World world(std::move(match));
  world.m_finishedBy = world.m_match.finishedBy();
  return world;
}

int World::finishedNumber() const {
  const auto& reasons = columns::finishReasons;
  const auto found = std::ranges::find(reasons, m_finishedBy);
  return found == reasons.end() ? 0 : static_cast<int>(found - reasons.begin()) + 1;
}

void World::play(int ticks) {
  for (int i = 0; i < ticks && m_finishedBy.empty(); ++i) {
    m_match.tick();
    m_sensed = true;
    m_finishedBy = m_match.finishedBy();
    if (++m_sinceForgot >= ticksBetweenForgetting) forgetEvents();
  }
}

std::size_t World::fetchSelf() const {
  // What a tick reads of its 6.5 KB. The state is a member of the simulation.
  const Scenario& scenario = m_match.scenario();
  const sim::Simulation& simulation = m_match.simulation();
  const sim::WorldState& state = simulation.state();
  return fetchObject(*this) + fetchObject(scenario.settings.tickRate) + fetchObject(scenario.stop) +
         fetch(&state.settings, &state.settings.referee) + fetch(&state.tick, &state.game) +
         fetch(&state + 1, &simulation + 1) + fetchObject(m_match.robots()) +
         fetchObject(m_match.pace());
}

void World::fetchParts() const {
  const sim::WorldState& state = m_match.simulation().state();
  fetchAll(state.robots);
  fetchAll(state.models);
  fetchAll(state.statistics);
  if (const auto* bodies = std::get_if<sim::RigidBodyState>(&state.physics)) {
    fetchAll(bodies->robots);
  }
  fetchAll(m_match.commands());
  fetchAll(m_match.percepts());
  for (const Blackboard* board : m_boards) {
    // Prefetches, which do not stall.
    static const std::vector<IntVar> lines = boardLines();
    for (const IntVar word : lines) (void)board->read(word);
  }
}

void World::forgetEvents() {
  m_sinceForgot = 0;
  m_match.drainEvents(m_news);
  m_news.clear();
}

WorldSnapshot World::snapshot() const {
  WorldSnapshot out;
  out.moment.state = m_match.simulation().state();
  out.finishedBy = m_finishedBy;
  for (std::size_t i = 0; i < m_boards.size(); ++i) {
    MomentRobot robot;
    robot.id = out.moment.state.robots[i].id;
    robot.behaviour = m_match.robots().all()[i]->behaviour;
    std::array<std::uint32_t, Blackboard::words> words;
    m_boards[i]->copyWords(words);
    robot.words.reserve(words.size());
    for (int word = 0; word < Blackboard::words; ++word) {
      robot.words.push_back({word, words[static_cast<std::size_t>(word)]});
    }
    out.moment.robots.push_back(std::move(robot));
  }
  return out;
}

Result<void> World::restore(const WorldSnapshot& snapshot) {
  const auto& mine = m_match.simulation().state();
  const auto& theirs = snapshot.moment.state;
  sim::SimulationSettings settings = theirs.settings;
  settings.seed = mine.settings.seed;
  if (!(settings == mine.settings) || theirs.models != mine.models ||
      !std::equal(theirs.robots.begin(), theirs.robots.end(), mine.robots.begin(),
                  mine.robots.end(), [](const auto& a, const auto& b) { return a.id == b.id; })) {
    return failure(ErrorCode::InvalidArgument,
                   "this snapshot is of a world of another scenario; restore it into worlds of its "
                   "own");
  }
  TRY(m_match.restore(snapshot.moment));
  findBoards();
  const auto& reasons = columns::finishReasons;
  const auto found = std::ranges::find(reasons, snapshot.finishedBy);
  m_finishedBy = found == reasons.end() ? std::string_view() : *found;
  m_sensed = false;
  forgetEvents();
  return {};
}

bool World::beginAgain(const Moment& beginning, std::uint64_t seed) {
  Moment seeded = beginning;
  seeded.state.settings.seed = seed;
  if (!m_match.restore(seeded)) return false;
  m_finishedBy = m_match.finishedBy();
  m_sensed = false;
  m_beginsQuickly = true;
  forgetEvents();
  return true;
}

}  // namespace pitchboard::link
