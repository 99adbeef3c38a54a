// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/capi/worlds.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <base/lined_json.h>
#include <base/try.h>

#include "step_team.h"
#include "world.h"
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

/// Fills rows one after another.
struct Filling {
  double* out;
  template <class Value>
  void operator()(std::string_view /*name*/, std::string_view /*meaning*/, const Value& value) {
    *out++ = columns::number(value);
  }
};

}  // namespace

struct Worlds::Parts {
  Scenario scenario;
  MatchOptions options;
  std::vector<World> worlds;
  std::vector<RobotId> robots;
  RobotVariables variables;
  /// Of worlds that remember nothing but their moment: from it they begin again. What the scenario
  /// writes at once stands there, and is left out of `later`: it would be written once more.
  std::optional<Moment> beginning;
  Scenario later;
  StepTeam team;
  mutable sim::Snapshot seen;  // scratch

  std::size_t robotRows() const { return worlds.size() * robots.size(); }

  Result<World> make(std::uint64_t seed) const {
    if (!beginning) return World::create(scenario, options, seed);
    auto world = World::create(later, options, seed);
    if (world) (void)world->beginAgain(*beginning, seed);
    return world;
  }

  /// A world is determined by its saved state and seed only if it has no processes and no referee.
  bool remembersNothing() const {
    return !scenario.settings.referee &&
           std::ranges::all_of(scenario.robots,
                               [](const ScenarioRobot& r) { return r.behaviour == noBehaviour; });
  }
  void findBeginning() {
    beginning.reset();
    if (!remembersNothing()) return;
    if (auto first = make(scenario.settings.seed)) beginning = first->snapshot().moment;
    later = scenario;
    std::erase_if(later.writes, [](const BlackboardWrite& write) { return write.time <= 0.0; });
  }

  Result<void> checkWorld(int world) const {
    if (world == all || (world >= 0 && static_cast<std::size_t>(world) < worlds.size())) return {};
    return failure(ErrorCode::NotFound, "there is no world " + std::to_string(world) +
                                            "; there are " + std::to_string(worlds.size()) +
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
  /// Calls change(world, its index) for one or all, until one fails.
  template <class Change>
  Result<void> changeEach(int world, const Change& change) {
    TRY(checkWorld(world));
    for (std::size_t i = 0; i < worlds.size(); ++i) {
      if (world != all && static_cast<std::size_t>(world) != i) continue;
      TRY(change(worlds[i], i));
    }
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
  parts->findBeginning();
  parts->worlds.reserve(static_cast<std::size_t>(options.count));
  for (int i = 0; i < options.count; ++i) {
    parts->worlds.push_back(
        TRY(parts->make(parts->scenario.settings.seed + static_cast<std::uint64_t>(i))));
  }
  const int useful = std::min(options.threads, options.count);
  TRY(parts->team.start(useful));
  return Worlds(std::move(parts));
}

std::size_t Worlds::count() const {
  return m_parts->worlds.size();
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
  auto changed = m_parts->changeEach(all, [&](World& world, std::size_t /*index*/) {
    return world.match().robots().setBehaviour(robot, behaviour);
  });
  if (!changed) return changed;
  for (ScenarioRobot& one : m_parts->scenario.robots) {
    if (one.identity.id == robot) one.behaviour = behaviour;
  }
  for (World& world : m_parts->worlds) world.mustBeMadeAnew();
  m_parts->findBeginning();
  return {};
}

Result<void> Worlds::reset(int world, std::uint64_t seed) {
  return m_parts->changeEach(world, [&](World& one, std::size_t index) -> Result<void> {
    const std::uint64_t own = world == all ? seed + index : seed;
    if (one.beginsQuickly() && one.beginAgain(*m_parts->beginning, own)) return {};
    one = TRY(m_parts->make(own));
    return {};
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
  auto& worlds = m_parts->worlds;
  // So few stay in a core's cache by themselves.
  constexpr std::size_t few = 200;
  const bool many = worlds.size() > few;
  m_parts->team.run(worlds.size(), static_cast<std::size_t>(ticks),
                    [&](std::size_t i, std::size_t end) {
                      if (many && i + 2 < end) worlds[i + 2].fetchSelf();
                      if (many && i + 1 < end) worlds[i + 1].fetchParts();
                      worlds[i].play(ticks);
                    });
  return {};
}

std::string_view Worlds::finishedBy(std::size_t world) const {
  return m_parts->worlds[world].finishedBy();
}

std::size_t Worlds::sizeOf(WorldArray array) const {
  const std::size_t rows = array == WorldArray::Game ? count() : m_parts->robotRows();
  return rows * columnsOf(array).size();
}

Result<void> Worlds::read(WorldArray array, std::span<double> out) const {
  constexpr std::array<std::string_view, worldArrays> names{"percepts", "robots", "game"};
  TRY(checkSize(names[static_cast<std::size_t>(array)], out.size(), sizeOf(array)));
  Filling filling{out.data()};
  for (const World& world : m_parts->worlds) {
    if (array == WorldArray::Percepts) {
      const std::size_t row = columnsOf(array).size();
      for (const sim::Percepts& percepts : world.match().percepts()) {
        if (world.sensed()) {
          columns::visitPercepts(percepts, filling);
        } else {
          filling.out = std::fill_n(filling.out, row, columns::nothing);
        }
      }
      continue;
    }
    const sim::Simulation& simulation = world.match().simulation();
    sim::Snapshot& seen = m_parts->seen;
    simulation.snapshot(seen);
    if (array == WorldArray::Game) {
      columns::visitGame(seen, simulation.state(), world.finishedNumber(), filling);
    } else {
      for (const sim::RobotSnapshot& robot : seen.robots) columns::visitRobot(robot, filling);
    }
  }
  return {};
}

Result<void> Worlds::readBoards(std::span<std::uint32_t> out) const {
  const std::size_t rows = m_parts->robotRows();
  if (auto fits = checkSize("blackboards", out.size(), rows * Blackboard::words); !fits)
    return fits;
  std::size_t at = 0;
  for (const World& world : m_parts->worlds) {
    for (std::size_t i = 0; i < robots(); ++i, at += Blackboard::words) {
      world.board(i).copyWords(out.subspan(at).first<Blackboard::words>());
    }
  }
  return {};
}

Result<void> Worlds::readVariables(std::span<const Variable> variables,
                                   std::span<double> out) const {
  const std::size_t rows = m_parts->robotRows();
  TRY(checkSize("variables", out.size(), rows * variables.size()));
  double* to = out.data();
  for (const World& world : m_parts->worlds) {
    for (std::size_t i = 0; i < robots(); ++i) {
      for (const Variable& variable : variables) {
        *to++ = variable.type == VariableType::Int
                    ? static_cast<double>(world.board(i).read(IntVar{variable.index}))
                    : static_cast<double>(world.board(i).read(FloatVar{variable.index}));
      }
    }
  }
  return {};
}

Result<void> Worlds::readHashes(std::span<std::uint64_t> out) const {
  TRY(checkSize("hashes", out.size(), count()));
  std::transform(m_parts->worlds.begin(), m_parts->worlds.end(), out.begin(),
                 [](const World& world) { return world.match().simulation().hash(); });
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
  const double* from = values.data();
  for (World& world : m_parts->worlds) {
    for (std::size_t i = 0; i < robots(); ++i) {
      for (const Variable& variable : variables) {
        const double value = *from++;
        if (std::isnan(value)) continue;
        if (variable.type == VariableType::Int) {
          world.board(i).write(IntVar{variable.index}, static_cast<int>(value));
        } else {
          world.board(i).write(FloatVar{variable.index}, static_cast<float>(value));
        }
      }
    }
  }
  return {};
}

Result<void> Worlds::writeCommands(std::span<const std::int32_t> commands) {
  const RobotVariables& v = m_parts->variables;
  const std::array variables{v.decisionActionA,      v.decisionActionB,      v.decisionSearchOn,
                             v.decisionActionVision, v.decisionLocalization, v.imuReset};
  const std::size_t rows = m_parts->robotRows();
  if (auto fits = checkSize("commands", commands.size(), rows * variables.size()); !fits)
    return fits;
  const std::int32_t* from = commands.data();
  for (World& world : m_parts->worlds) {
    for (std::size_t i = 0; i < robots(); ++i) {
      for (const IntVar variable : variables) {
        const std::int32_t value = *from++;
        if (value != keep) world.board(i).write(variable, value);
      }
    }
  }
  return {};
}

Result<void> Worlds::writeActions(std::span<const std::int32_t> actions) {
  TRY(checkSize("actions", actions.size(), m_parts->robotRows()));
  const IntVar variable = m_parts->variables.decisionActionA;
  const std::int32_t* from = actions.data();
  for (World& world : m_parts->worlds) {
    for (std::size_t i = 0; i < robots(); ++i) {
      const std::int32_t value = *from++;
      if (value != keep) world.board(i).write(variable, value);
    }
  }
  return {};
}

Result<void> Worlds::placeRobot(int world, RobotId robot, const Pose& pose) {
  return m_parts->changeEach(world, [&](World& one, std::size_t /*index*/) {
    return one.match().simulation().placeRobot(robot, pose);
  });
}

Result<void> Worlds::placeBall(int world, const Point& place, const Velocity& velocity) {
  return m_parts->changeEach(world, [&](World& one, std::size_t /*index*/) {
    return one.match().simulation().placeBall(place, velocity);
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
  return m_parts->worlds[static_cast<std::size_t>(world)].snapshot();
}

Result<void> Worlds::restore(int world, const WorldSnapshot& snapshot) {
  return m_parts->changeEach(
      world, [&](World& one, std::size_t /*index*/) { return one.restore(snapshot); });
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
