// SPDX-License-Identifier: GPL-3.0-or-later
#include "steered_worlds.h"

#include <algorithm>
#include <utility>

#include <base/try.h>

#include "world_columns.h"

namespace pitchboard::link {
namespace {

constexpr std::size_t wordsPerLine = 64 / sizeof(std::uint32_t);
// A line more than a blackboard has: at a distance of a power of two, the lines that a tick touches
// would share few sets of the processor's caches.
constexpr std::size_t boardDistance = Blackboard::words + wordsPerLine;

/// The variables that the bridge reads or writes in every tick, ints and floats.
constexpr IntVar RobotVariables::*busyInts[] = {&RobotVariables::decisionActionA,
                                                &RobotVariables::decisionActionB,
                                                &RobotVariables::decisionSearchOn,
                                                &RobotVariables::imuReset,
                                                &RobotVariables::decisionActionVision,
                                                &RobotVariables::decisionLocalization,
                                                &RobotVariables::imuState,
                                                &RobotVariables::controlAction,
                                                &RobotVariables::controlMoving,
                                                &RobotVariables::voltage,
                                                &RobotVariables::visionLost,
                                                &RobotVariables::controlWorking,
                                                &RobotVariables::visionWorking,
                                                &RobotVariables::imuWorking,
                                                &RobotVariables::decisionWorking};
constexpr FloatVar RobotVariables::*busyFloats[] = {
    &RobotVariables::imuEulerX,       &RobotVariables::imuEulerY,
    &RobotVariables::imuEulerZ,       &RobotVariables::imuGyroX,
    &RobotVariables::imuGyroY,        &RobotVariables::imuGyroZ,
    &RobotVariables::imuAccelX,       &RobotVariables::imuAccelY,
    &RobotVariables::imuAccelZ,       &RobotVariables::visionBallDist,
    &RobotVariables::visionBallAngle, &RobotVariables::visionPanDeg,
    &RobotVariables::visionTiltDeg};

/// Puts the busy words side by side, the ints in front of the floats: two cache lines instead of
/// fourteen. Returns the variables at their new places.
RobotVariables gather(std::array<int, Blackboard::words>& places) {
  RobotVariables variables;
  const auto move = [&](int word, int to) {
    // What stood there goes where this word was.
    std::swap(*std::ranges::find(places, to), places[static_cast<std::size_t>(word)]);
  };
  int to = Blackboard::floatOffset - static_cast<int>(std::size(busyInts));
  for (const auto variable : busyInts) move((variables.*variable).index, to++);
  const auto moveFloat = [&](FloatVar variable) {
    move(Blackboard::floatOffset + variable.index, to++);
  };
  for (const auto variable : busyFloats) moveFloat(variables.*variable);
  for (const FloatVar variable : variables.landmarkDeg) moveFloat(variable);
  return variables;
}

}  // namespace

SteeredWorlds::Stage::Stage(sim::Simulation made)
    : simulation(std::move(made)),
      commands(simulation.robotCount()),
      percepts(simulation.robotCount()) {}

SteeredWorlds::SteeredWorlds(const Scenario& scenario, WorldSnapshot beginning, std::size_t count)
    : m_stop(scenario.stop),
      m_beginning(std::move(beginning)),
      m_robots(m_beginning.moment.robots.size()),
      m_worlds(count),
      m_words(count * m_robots * boardDistance + 2 * wordsPerLine),
      m_row(columnsOf(WorldArray::Percepts).size() -
            2 * (sim::Percepts::maxSeenRobots -
                 std::min<std::size_t>(m_robots, sim::Percepts::maxSeenRobots))) {
  m_percepts.resize(count * m_robots * m_row);
  RobotVariables variables = gather(m_places);
  for (const auto variable : busyInts) variables.*variable = placed(variables.*variable);
  for (const auto variable : busyFloats) variables.*variable = placed(variables.*variable);
  for (FloatVar& variable : variables.landmarkDeg) variable = placed(variable);
  m_bridge.emplace(variables);
  // The first of the busy words begins a line.
  const std::size_t busy = Blackboard::floatOffset - std::size(busyInts);
  const auto misplaced =
      (reinterpret_cast<std::uintptr_t>(m_words.data()) / sizeof(std::uint32_t) + busy) %
      wordsPerLine;
  std::uint32_t* const words = m_words.data() + (wordsPerLine - misplaced) % wordsPerLine;
  for (std::size_t i = 0; i < count * m_robots; ++i) {
    m_boards.push_back(Blackboard::over(
        std::span<std::uint32_t, Blackboard::words>(words + i * boardDistance, Blackboard::words)));
  }
}

Result<std::unique_ptr<SteeredWorlds>> SteeredWorlds::create(const Scenario& scenario,
                                                             const MatchOptions& options,
                                                             std::size_t count,
                                                             std::size_t workers) {
  const bool mayRemember =
      scenario.settings.referee ||
      std::ranges::any_of(scenario.robots,
                          [](const auto& robot) { return robot.behaviour != noBehaviour; }) ||
      std::ranges::any_of(scenario.writes, [](const auto& write) { return write.time > 0.0; });
  if (mayRemember) return nullptr;
  MatchWorlds first(scenario, options);
  TRY(first.add(scenario.settings.seed));
  const auto& slots = first.match(0).robots().all();
  if (std::ranges::any_of(slots, [](const auto& slot) { return !slot->processes.empty(); })) {
    return nullptr;
  }
  std::unique_ptr<SteeredWorlds> made(new SteeredWorlds(scenario, first.snapshot(0), count));
  const sim::WorldState& state = made->m_beginning.moment.state;
  for (std::size_t i = 0; i < workers; ++i) {
    auto simulation = TRY(sim::Simulation::create(state.settings));
    TRY(simulation.restore(state));
    made->m_stages.emplace_back(std::move(simulation));
  }
  for (std::size_t i = 0; i < count; ++i) TRY(made->reset(i, state.settings.seed + i));
  return made;
}

Result<void> SteeredWorlds::take(MatchWorlds& matches) {
  for (std::size_t i = 0; i < m_worlds.size(); ++i) {
    TRY(restore(i, matches.snapshot(i)));
    if (!matches.sensed(i)) continue;
    m_worlds[i].sensed = true;
    keepPercepts(i, matches.match(i).percepts());
  }
  return {};
}

bool SteeredWorlds::canRestore(const WorldSnapshot& snapshot) {
  return std::ranges::all_of(snapshot.moment.robots,
                             [](const auto& robot) { return robot.behaviour == noBehaviour; });
}

void SteeredWorlds::begin(std::size_t world, const WorldSnapshot& moment) {
  const sim::WorldState& state = moment.moment.state;
  World& begun = m_worlds[world];
  begun.course = {state.settings.seed, state.tick,       state.score,  state.clockRunning,
                  state.clockTicks,    state.statistics, state.physics};
  begun.end.forget();
  begun.sensed = false;
  begun.finishedBy = columns::finishReason(moment.finishedBy);
  const std::span<Blackboard> boards = boardsOf(world);
  for (std::size_t i = 0; i < m_robots; ++i) {
    for (const BoardWord& word : moment.moment.robots[i].words) {
      boards[i].write(placed(IntVar{word.index}), std::bit_cast<int>(word.bits));
    }
  }
}

Result<void> SteeredWorlds::reset(std::size_t world, std::uint64_t seed) {
  begin(world, m_beginning);
  m_worlds[world].course.seed = seed;
  return {};
}

WorldSnapshot SteeredWorlds::snapshot(std::size_t world) {
  WorldSnapshot out;
  (void)withSimulation(world, [&](const sim::Simulation& simulation) -> Result<void> {
    out.moment.state = simulation.state();
    return {};
  });
  out.finishedBy = m_worlds[world].finishedBy;
  for (std::size_t i = 0; i < m_robots; ++i) {
    out.moment.robots.push_back(
        saved(out.moment.state.robots[i].id, std::string(noBehaviour), boardsOf(world)[i]));
  }
  return out;
}

Result<void> SteeredWorlds::restore(std::size_t world, const WorldSnapshot& snapshot) {
  TRY(checkSnapshot(snapshot, m_beginning.moment.state));
  begin(world, snapshot);
  return {};
}

Result<void> SteeredWorlds::withSimulation(std::size_t world, const Use& use) {
  sim::Simulation& simulation = m_stages.front().simulation;
  simulation.exchange(m_worlds[world].course);
  auto done = use(simulation);
  simulation.exchange(m_worlds[world].course);
  return done;
}

void SteeredWorlds::tick(Stage& stage, std::size_t world, bool keeps) {
  World& played = m_worlds[world];
  const std::span<Blackboard> boards = boardsOf(world);
  sim::Simulation& simulation = stage.simulation;
  simulation.exchange(played.course);
  for (std::size_t i = 0; i < m_robots; ++i) stage.commands[i] = m_bridge->read(boards[i]);
  simulation.step(stage.commands, stage.percepts);
  for (std::size_t i = 0; i < m_robots; ++i) {
    m_bridge->publish(stage.percepts[i], boards[i], m_robots);
  }
  played.end.look(simulation.events());
  played.finishedBy = played.end.reason(m_stop, simulation.state());
  simulation.exchange(played.course);
  played.sensed = true;
  if (keeps || !played.finishedBy.empty()) keepPercepts(world, stage.percepts);
}

/// Worlds that lie next to each other play their ticks together, for the random numbers' sake.
void SteeredWorlds::play(Stage& stage, std::size_t first, std::size_t last, int ticks) {
  for (int i = 0; i < ticks; ++i) {
    stage.playing.clear();
    stage.ticks.clear();
    for (std::size_t world = first; world < last; ++world) {
      if (!m_worlds[world].finishedBy.empty()) continue;
      stage.playing.push_back(world);
      stage.ticks.push_back({m_worlds[world].course.seed, m_worlds[world].course.tick});
    }
    if (stage.playing.empty()) return;
    stage.simulation.drawAhead(stage.ticks);
    for (const std::size_t world : stage.playing) tick(stage, world, i + 1 == ticks);
  }
}

void SteeredWorlds::step(StepTeam& team, int ticks) {
  // So many that their random numbers stay in the nearest cache until they are used.
  const std::size_t together = std::max<std::size_t>(1, 64 / std::max<std::size_t>(1, m_robots));
  team.run(m_worlds.size(), static_cast<std::size_t>(ticks),
           [&](std::size_t worker, std::size_t first, std::size_t last) {
             for (; first < last; first += together) {
               play(m_stages[worker], first, std::min(last, first + together), ticks);
             }
           });
}

void SteeredWorlds::keepPercepts(std::size_t world, std::span<const sim::Percepts> percepts) {
  columns::Filling filling{m_percepts.data() + world * m_robots * m_row};
  for (const sim::Percepts& one : percepts) columns::visitPercepts(one, filling, m_robots);
}

void SteeredWorlds::readPercepts(std::span<double> out) const {
  const std::size_t width = columnsOf(WorldArray::Percepts).size();
  const std::size_t front = m_row - columns::behindSeen;
  const double* row = m_percepts.data();
  columns::Filling filling{out.data()};
  for (const World& world : m_worlds) {
    for (std::size_t i = 0; i < m_robots; ++i, row += m_row) {
      if (!world.sensed) {
        filling.leaveOut(width);
        continue;
      }
      filling.copy({row, front});
      filling.leaveOut(width - m_row);
      filling.copy({row + front, columns::behindSeen});
    }
  }
}

}  // namespace pitchboard::link
