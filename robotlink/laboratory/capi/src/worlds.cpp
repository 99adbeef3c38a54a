// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/capi/worlds.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include <base/lined_json.h>
#include <base/try.h>

#include "match_worlds.h"
#include "steered_worlds.h"
#include "step_team.h"
#include "world_columns.h"

namespace pitchboard::link {
namespace {

Error wrongSize(std::string_view what, std::size_t given, std::size_t wanted) {
  return {ErrorCode::InvalidArgument,
          "the array of " + std::string(what) + " has " + std::to_string(given) +
              " values; these worlds need " + std::to_string(wanted),
          ""};
}

Result<void> checkSize(std::string_view what, std::size_t given, std::size_t wanted) {
  if (given != wanted) return tl::unexpected(wrongSize(what, given, wanted));
  return {};
}

Result<void> checkRange(std::string_view what, int value, int most) {
  if (value >= 1 && value <= most) return {};
  return failure(ErrorCode::InvalidArgument, std::string(what) + " must lie between 1 and " +
                                                 std::to_string(most) + ", not be " +
                                                 std::to_string(value));
}

/// A world is played by what is inside this program: programs of a team would not keep up, and
/// would share their blackboards with every other world.
Result<void> keepInside(RuntimeChoice& choice) {
  if (!choice.isChosen()) return {};
  const auto runtime = TRY(loadRuntime(choice));
  const auto& all = runtime.processes;
  if (std::ranges::any_of(all, [](const auto& p) { return !p.isReference(); })) {
    return failure(ErrorCode::Unsupported,
                   "separate programs cannot play in worlds; remove \"runtime\" from the scenario, "
                   "or set the robot's behaviour to \"none\" and control it yourself");
  }
  if (all.empty()) choice = {};
  return {};
}

bool fitsInt(double value) {
  return value >= std::numeric_limits<std::int32_t>::min() &&
         value <= std::numeric_limits<std::int32_t>::max() && value == std::floor(value);
}

}  // namespace

struct Worlds::Parts {
  Scenario scenario;
  MatchOptions options;
  std::size_t count = 0;
  std::vector<RobotId> robots;
  RobotVariables variables;
  StepTeam team;
  // One of them is there.
  std::unique_ptr<SteeredWorlds> steered;
  std::unique_ptr<MatchWorlds> matches;
  mutable sim::Snapshot seen;  // scratch

  std::size_t robotRows() const { return count * robots.size(); }
  WorldGroup& worlds() const {
    return steered ? static_cast<WorldGroup&>(*steered) : static_cast<WorldGroup&>(*matches);
  }

  Result<void> makeSteered() {
    steered = TRY(SteeredWorlds::create(scenario, options, count, team.workers()));
    return {};
  }
  Result<void> makeMatches() {
    auto made = std::make_unique<MatchWorlds>(scenario, options);
    for (std::size_t i = 0; i < count; ++i) TRY(made->add(scenario.settings.seed + i));
    matches = std::move(made);
    return {};
  }
  /// Continues the same worlds as matches.
  Result<void> becomeMatches() {
    if (matches) return {};
    TRY(makeMatches());
    for (std::size_t i = 0; i < count; ++i) TRY(matches->restore(i, steered->snapshot(i)));
    steered.reset();
    return {};
  }
  /// The other way round, if that is possible.
  Result<void> becomeSteered() {
    TRY(makeSteered());
    if (!steered) return {};
    TRY(steered->take(*matches));
    matches.reset();
    return {};
  }

  /// Writes these variables of each robot, except for values that say `keep`.
  void writeInts(std::span<IntVar> variables, std::span<const std::int32_t> values) {
    for (IntVar& variable : variables) variable = worlds().placed(variable);
    const std::int32_t* from = values.data();
    for (Blackboard& board : worlds().boards()) {
      for (const IntVar variable : variables) {
        const std::int32_t value = *from++;
        if (value != keep) board.write(variable, value);
      }
    }
  }

  Result<void> checkWorld(int world) const {
    if (world == all || (world >= 0 && static_cast<std::size_t>(world) < count)) return {};
    return failure(ErrorCode::NotFound, "there is no world " + std::to_string(world) +
                                            "; there are " + std::to_string(count) +
                                            ", counted from 0");
  }
  Result<void> checkRobot(RobotId robot) const {
    if (std::ranges::find(robots, robot) != robots.end()) return {};
    return failure(ErrorCode::NotFound,
                   "there is no robot " + std::to_string(robot.value) + " on the field");
  }
  /// All of them are there, and there are as many of the others.
  Result<void> checkWorlds(std::span<const int> which, std::size_t others) const {
    if (which.size() != others) {
      return failure(ErrorCode::InvalidArgument, "there must be one value for each of the " +
                                                     std::to_string(which.size()) + " worlds");
    }
    for (const int world : which) {
      TRY(checkWorld(world == all ? -2 : world));
    }
    return {};
  }
  /// Calls change(index) for one or all, until one fails.
  template <class Change>
  Result<void> changeEach(int world, const Change& change) {
    TRY(checkWorld(world));
    const std::size_t first = world == all ? 0 : static_cast<std::size_t>(world);
    const std::size_t last = world == all ? count : first + 1;
    for (std::size_t i = first; i < last; ++i) TRY(change(i));
    return {};
  }
};

Worlds::Worlds(std::unique_ptr<Parts> parts) : m_parts(std::move(parts)) {}
Worlds::Worlds(Worlds&&) noexcept = default;
Worlds& Worlds::operator=(Worlds&&) noexcept = default;
Worlds::~Worlds() = default;

Result<Worlds> Worlds::create(const Scenario& scenario, const WorldsOptions& options) {
  for (auto checked :
       {checkRange("the number of worlds", options.count, maxWorlds),
        checkRange("the number of threads", options.threads, maxThreads),
        checkRange("the number of particles", options.particles.value_or(1), 100000)}) {
    if (!checked) return tl::unexpected(checked.error());
  }
  auto parts = std::make_unique<Parts>();
  parts->scenario = scenario;
  if (options.seed) parts->scenario.settings.seed = *options.seed;
  for (ScenarioRobot& robot : parts->scenario.robots) {
    TRY(keepInside(robot.runtime));
    parts->robots.push_back(robot.identity.id);
  }
  for (auto& [team, runtime] : parts->scenario.runtimes) {
    TRY(keepInside(runtime));
  }
  parts->options.cognition = Cognition::Inline;
  if (options.particles) parts->options.process.particles = *options.particles;
  parts->count = static_cast<std::size_t>(options.count);
  TRY(parts->team.start(std::min(options.threads, options.count)));
  TRY(parts->makeSteered());
  if (!parts->steered) TRY(parts->makeMatches());
  return Worlds(std::move(parts));
}

std::size_t Worlds::count() const {
  return m_parts->count;
}

std::size_t Worlds::robots() const {
  return m_parts->robots.size();
}

double Worlds::tickRate() const {
  return m_parts->scenario.settings.tickRate;
}

std::span<const RobotId> Worlds::robotIds() const {
  return m_parts->robots;
}

Result<void> Worlds::setBehaviour(RobotId robot, const std::string& behaviour) {
  TRY(m_parts->checkRobot(robot));
  if (m_parts->steered && behaviour == noBehaviour) return {};
  TRY(m_parts->becomeMatches());
  TRY(m_parts->matches->setBehaviour(robot, behaviour));
  for (ScenarioRobot& one : m_parts->scenario.robots) {
    if (one.identity.id == robot) one.behaviour = behaviour;
  }
  return m_parts->becomeSteered();
}

Result<void> Worlds::reset(int world, std::uint64_t seed) {
  return m_parts->changeEach(world, [&](std::size_t i) {
    return m_parts->worlds().reset(i, world == all ? seed + i : seed);
  });
}

Result<void> Worlds::reset(std::span<const int> worlds, std::span<const std::uint64_t> seeds) {
  TRY(m_parts->checkWorlds(worlds, seeds.size()));
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    TRY(reset(worlds[i], seeds[i]));
  }
  return {};
}

Result<void> Worlds::step(int ticks) {
  TRY(checkRange("the number of ticks", ticks, maxTicks));
  m_parts->worlds().step(m_parts->team, ticks);
  return {};
}

std::string_view Worlds::finishedBy(std::size_t world) const {
  return m_parts->worlds().finishedBy(world);
}

std::size_t Worlds::sizeOf(WorldArray array) const {
  const std::size_t rows = array == WorldArray::Game ? count() : m_parts->robotRows();
  return rows * columnsOf(array).size();
}

Result<void> Worlds::read(WorldArray array, std::span<double> out) const {
  constexpr std::array<std::string_view, worldArrays> names{"percepts", "robots", "game"};
  TRY(checkSize(names[static_cast<std::size_t>(array)], out.size(), sizeOf(array)));
  WorldGroup& worlds = m_parts->worlds();
  if (array == WorldArray::Percepts) {
    worlds.readPercepts(out);
    return {};
  }
  columns::Filling filling{out.data()};
  for (std::size_t i = 0; i < count(); ++i) {
    TRY(worlds.withSimulation(i, [&](const sim::Simulation& simulation) -> Result<void> {
      sim::Snapshot& seen = m_parts->seen;
      simulation.snapshot(seen);
      if (array == WorldArray::Game) {
        columns::visitGame(seen, simulation.state(), columns::finishNumber(worlds.finishedBy(i)),
                           filling);
      } else {
        for (const sim::RobotSnapshot& robot : seen.robots) columns::visitRobot(robot, filling);
      }
      return {};
    }));
  }
  return {};
}

Result<void> Worlds::readBoards(std::span<std::uint32_t> out) const {
  const std::size_t rows = m_parts->robotRows();
  if (auto fits = checkSize("blackboards", out.size(), rows * Blackboard::words); !fits)
    return fits;
  const WorldGroup& worlds = m_parts->worlds();
  std::uint32_t* to = out.data();
  for (const Blackboard& board : worlds.boards()) {
    for (int word = 0; word < Blackboard::words; ++word) {
      *to++ = std::bit_cast<std::uint32_t>(board.read(worlds.placed(IntVar{word})));
    }
  }
  return {};
}

Result<void> Worlds::readVariables(std::span<const Variable> variables,
                                   std::span<double> out) const {
  const std::size_t rows = m_parts->robotRows();
  TRY(checkSize("variables", out.size(), rows * variables.size()));
  const std::vector<Variable> placed = m_parts->worlds().placed(variables);
  double* to = out.data();
  for (const Blackboard& board : m_parts->worlds().boards()) {
    for (const Variable& variable : placed) {
      *to++ = variable.type == VariableType::Int
                  ? static_cast<double>(board.read(IntVar{variable.index}))
                  : static_cast<double>(board.read(FloatVar{variable.index}));
    }
  }
  return {};
}

Result<void> Worlds::readHashes(std::span<std::uint64_t> out) const {
  TRY(checkSize("hashes", out.size(), count()));
  for (std::size_t i = 0; i < count(); ++i) {
    TRY(m_parts->worlds().withSimulation(i, [&](const sim::Simulation& simulation) -> Result<void> {
      out[i] = simulation.hash();
      return {};
    }));
  }
  return {};
}

Result<void> Worlds::writeVariables(std::span<const Variable> variables,
                                    std::span<const double> values) {
  const std::size_t rows = m_parts->robotRows();
  if (auto fits = checkSize("variables", values.size(), rows * variables.size()); !fits)
    return fits;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Variable& variable = variables[i % variables.size()];
    if (variable.type == VariableType::Int && !std::isnan(values[i]) && !fitsInt(values[i])) {
      return failure(ErrorCode::InvalidArgument, shortest(values[i]) + " is not a 32-bit integer",
                     variable.name);
    }
  }
  const std::vector<Variable> placed = m_parts->worlds().placed(variables);
  const double* from = values.data();
  for (Blackboard& board : m_parts->worlds().boards()) {
    for (const Variable& variable : placed) {
      const double value = *from++;
      if (std::isnan(value)) continue;
      if (variable.type == VariableType::Int) {
        board.write(IntVar{variable.index}, static_cast<int>(value));
      } else {
        board.write(FloatVar{variable.index}, static_cast<float>(value));
      }
    }
  }
  return {};
}

Result<void> Worlds::writeCommands(std::span<const std::int32_t> commands) {
  const RobotVariables& v = m_parts->variables;
  std::array variables{v.decisionActionA,      v.decisionActionB,      v.decisionSearchOn,
                       v.decisionActionVision, v.decisionLocalization, v.imuReset};
  TRY(checkSize("commands", commands.size(), m_parts->robotRows() * variables.size()));
  m_parts->writeInts(variables, commands);
  return {};
}

Result<void> Worlds::writeActions(std::span<const std::int32_t> actions) {
  TRY(checkSize("actions", actions.size(), m_parts->robotRows()));
  std::array variables{m_parts->variables.decisionActionA};
  m_parts->writeInts(variables, actions);
  return {};
}

Result<void> Worlds::placeRobot(int world, RobotId robot, const Pose& pose) {
  return m_parts->changeEach(world, [&](std::size_t i) {
    return m_parts->worlds().withSimulation(
        i, [&](sim::Simulation& simulation) { return simulation.placeRobot(robot, pose); });
  });
}

Result<void> Worlds::placeBall(int world, const Point& place, const Velocity& velocity) {
  return m_parts->changeEach(world, [&](std::size_t i) {
    return m_parts->worlds().withSimulation(
        i, [&](sim::Simulation& simulation) { return simulation.placeBall(place, velocity); });
  });
}

Result<void> Worlds::placeRobots(std::span<const int> worlds, RobotId robot,
                                 std::span<const Pose> poses) {
  TRY(m_parts->checkWorlds(worlds, poses.size()));
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    TRY(placeRobot(worlds[i], robot, poses[i]));
  }
  return {};
}

Result<void> Worlds::placeBalls(std::span<const int> worlds, std::span<const Point> places,
                                std::span<const Velocity> velocities) {
  TRY(m_parts->checkWorlds(worlds, places.size()));
  TRY(m_parts->checkWorlds(worlds, velocities.size()));
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    TRY(placeBall(worlds[i], places[i], velocities[i]));
  }
  return {};
}

Result<WorldSnapshot> Worlds::snapshot(int world) const {
  TRY(m_parts->checkWorld(world));
  if (world == all) {
    return failure(ErrorCode::InvalidArgument, "a snapshot belongs to one world; give its number");
  }
  return m_parts->worlds().snapshot(static_cast<std::size_t>(world));
}

Result<void> Worlds::restore(int world, const WorldSnapshot& snapshot) {
  TRY(m_parts->checkWorld(world));
  if (!SteeredWorlds::canRestore(snapshot)) TRY(m_parts->becomeMatches());
  return m_parts->changeEach(world,
                             [&](std::size_t i) { return m_parts->worlds().restore(i, snapshot); });
}

Result<void> Worlds::restore(std::span<const int> worlds, std::span<const std::uint64_t> seeds,
                             const WorldSnapshot& snapshot) {
  TRY(m_parts->checkWorlds(worlds, seeds.size()));
  WorldSnapshot seeded = snapshot;
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    seeded.moment.state.settings.seed = seeds[i];
    TRY(restore(worlds[i], seeded));
  }
  return {};
}

Result<Variable> worldVariable(std::string_view name) {
  const VariableCatalog& catalog = VariableCatalog::published();
  if (const Variable* found = catalog.find(name)) return *found;
  std::vector<std::string_view> known;
  for (const Variable& variable : catalog.variables()) known.push_back(variable.name);
  return failure(ErrorCode::NotFound, unknownName("blackboard variable", name, known));
}

}  // namespace pitchboard::link
