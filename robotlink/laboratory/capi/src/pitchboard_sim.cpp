// SPDX-License-Identifier: GPL-3.0-or-later
// The C interface of the simulator: finds what a handle stands for and calls Worlds and Rollouts.
#include <pitchboard_sim.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <base/try.h>
#include <robotlink/capi/rollout_rows.h>
#include <robotlink/capi/worlds.h>
#include <robotlink/rollout/rollout_start.h>

#include "c_interface.h"

using namespace pitchboard;
using namespace pitchboard::link;
using namespace pitchboard::link::capi;

namespace {

static_assert(PB_KEEP == Worlds::keep && PB_ALL == Worlds::all);
static_assert(PB_BOARD_WORDS == Blackboard::words);

struct LockedWorlds {
  explicit LockedWorlds(Worlds made) : worlds(std::move(made)) {}
  std::mutex mutex;
  Worlds worlds;
};

struct LockedRollouts {
  LockedRollouts(rollout::Rollouts made, rollout::Belief belief)
      : rollouts(std::move(made)), beginning(std::move(belief)) {}
  std::mutex mutex;
  rollout::Rollouts rollouts;
  const rollout::Belief beginning;
};

// Never destroyed: a program may call from an atexit handler.
auto& worldHandles() {
  static auto* handles = new Handles<LockedWorlds, pb_worlds>;
  return *handles;
}
auto& rolloutHandles() {
  static auto* handles = new Handles<LockedRollouts, pb_rollouts>;
  return *handles;
}
auto& snapshotHandles() {
  static auto* handles = new Handles<const WorldSnapshot, pb_snapshot>;
  return *handles;
}

/// Calls use(Worlds&) on what the handle stands for.
template <class Use>
pb_status withWorlds(const pb_worlds* handle, const Use& use) {
  return guarded([&] {
    return withHandle(worldHandles(), handle, "worlds",
                      [&](LockedWorlds& found) { return reportStatus(use(found.worlds)); });
  });
}

/// The same of rollouts: use(LockedRollouts&).
template <class Use>
pb_status withRollouts(const pb_rollouts* handle, const Use& use) {
  return guarded([&] {
    return withHandle(rolloutHandles(), handle, "rollouts",
                      [&](LockedRollouts& found) { return reportStatus(use(found)); });
  });
}

std::optional<WorldArray> arrayOf(std::int32_t array) {
  if (array < 0 || static_cast<std::size_t>(array) >= worldArrays) return {};
  return static_cast<WorldArray>(array);
}

std::span<const WorldColumn> columns(std::int32_t array) {
  if (array == PB_COMMANDS) return commandColumns();
  if (array == PB_BELIEF_ROBOTS) return beliefRobotColumns();
  if (array == PB_BELIEF_GAME) return beliefGameColumns();
  if (array == PB_OUTCOMES) return outcomeColumns();
  const auto known = arrayOf(array);
  return known ? columnsOf(*known) : std::span<const WorldColumn>();
}

Result<Scenario> scenarioOf(const char* name, const char* json, const char* usual) {
  if (name && json) {
    return failure(
        ErrorCode::InvalidArgument,
        "the scenario can be given as a name or as text, not both; set one of them to null");
  }
  return json ? scenarioFromJson(json, "scenario") : loadScenario(name ? name : usual);
}

std::string textOf(const char* given) {
  return given ? given : "";
}

Result<Scenario> scenarioOf(const pb_options& options) {
  Scenario scenario = TRY(scenarioOf(options.scenario, options.text, "one-robot"));
  return changed(std::move(scenario),
                 {{}, textOf(options.noise), textOf(options.physics), options.duration});
}

/// Of an options struct that carries its own size.
template <class Options>
pb_status initialized(Options* options, size_t size, const Options& usual, const char* name) {
  if (options == nullptr) return missing("options");
  if (size != sizeof(Options)) {
    return reportStatus(PB_INVALID_ARGUMENT,
                        std::string("size must be sizeof(") + name + ") of this version's header");
  }
  *options = usual;
  options->size = size;
  return reportStatus(PB_OK, "");
}

// Variables as numbers: ints by their index, floats behind them.
constexpr std::int32_t firstFloat = Blackboard::intVariables;

Result<std::vector<Variable>> variablesOf(const std::int32_t* numbers, std::size_t count) {
  if (numbers == nullptr || count == 0 || count > std::size_t{2} * Blackboard::words) {
    return failure(ErrorCode::InvalidArgument,
                   "variables must be 1 to 1024 numbers that pb_find_variable() gave");
  }
  std::vector<Variable> variables(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t number = numbers[i];
    const bool isFloat = number >= firstFloat;
    const std::int32_t index = isFloat ? number - firstFloat : number;
    if (index < 0 || index >= (isFloat ? Blackboard::floatVariables : Blackboard::intVariables)) {
      return failure(
          ErrorCode::InvalidArgument,
          std::to_string(number) + " is not a variable; use a number from pb_find_variable()");
    }
    variables[i].type = isFloat ? VariableType::Float : VariableType::Int;
    variables[i].index = index;
  }
  return variables;
}

}  // namespace

std::int32_t pb_api_version(void) {
  return PB_API_VERSION;
}
const char* pb_version(void) {
  return PITCHBOARD_VERSION;
}

size_t pb_column_count(std::int32_t array) {
  return columns(array).size();
}
// The names are literals, which end with a zero.
const char* pb_column_name(std::int32_t array, size_t column) {
  const auto all = columns(array);
  return column < all.size() ? all[column].name.data() : nullptr;
}
const char* pb_column_words(std::int32_t array, size_t column) {
  const auto all = columns(array);
  return column < all.size() ? all[column].description.data() : nullptr;
}

pb_status pb_options_init(pb_options* options, size_t size) {
  pb_options usual{};
  usual.worlds = 1;
  usual.threads = 1;
  return initialized(options, size, usual, "pb_options");
}

pb_status pb_create(const pb_options* options, pb_worlds** worlds) {
  return guarded([&] {
    if (worlds == nullptr) return missing("worlds");
    *worlds = nullptr;
    if (options == nullptr) return missing("options");
    if (options->size != sizeof(pb_options)) {
      return reportStatus(PB_INVALID_ARGUMENT, "call pb_options_init() on these options first");
    }
    const auto scenario = scenarioOf(*options);
    if (!scenario) return reportStatus(tl::unexpected(scenario.error()));
    WorldsOptions wanted;
    wanted.count = options->worlds;
    wanted.threads = options->threads;
    if (options->has_seed != 0) wanted.seed = options->seed;
    if (options->particles != 0) wanted.particles = options->particles;
    auto made = Worlds::create(*scenario, wanted);
    if (!made) return reportStatus(tl::unexpected(made.error()));
    *worlds = worldHandles().add(std::make_shared<LockedWorlds>(std::move(*made)));
    return reportStatus(PB_OK, "");
  });
}

pb_status pb_destroy(pb_worlds* worlds) {
  return destroyHandle(worldHandles(), worlds, "worlds");
}

pb_status pb_get_shape(pb_worlds* worlds, pb_shape* shape) {
  return withWorlds(worlds, [&](Worlds& w) -> Result<void> {
    if (shape == nullptr) return refusal("shape must not be null");
    if (shape->size != sizeof(pb_shape)) {
      return refusal("set size to sizeof(pb_shape) of this version's header before");
    }
    shape->worlds = static_cast<std::int32_t>(w.count());
    shape->robots = static_cast<std::int32_t>(w.robots());
    shape->tick_rate = w.tickRate();
    return {};
  });
}

pb_status pb_robot_ids(pb_worlds* worlds, std::int32_t* ids, size_t count) {
  return withWorlds(worlds, [&](Worlds& w) -> Result<void> {
    if (spanOf(ids, count).size() != w.robots()) {
      return refusal("the array of robots needs " + std::to_string(w.robots()) + " values");
    }
    std::transform(w.robotIds().begin(), w.robotIds().end(), ids,
                   [](RobotId id) { return id.value; });
    return {};
  });
}

pb_status pb_set_behaviour(pb_worlds* worlds, std::int32_t robot, const char* behaviour) {
  return withWorlds(worlds, [&](Worlds& w) -> Result<void> {
    if (behaviour == nullptr) return refusal("behaviour must not be null");
    return w.setBehaviour(RobotId{robot}, behaviour);
  });
}

pb_status pb_reset(pb_worlds* worlds, std::int32_t world, std::uint64_t seed) {
  return withWorlds(worlds, [&](Worlds& w) { return w.reset(world, seed); });
}

pb_status pb_step(pb_worlds* worlds, std::int32_t ticks) {
  return withWorlds(worlds, [&](Worlds& w) { return w.step(ticks); });
}

pb_status pb_read(pb_worlds* worlds, std::int32_t array, double* out, size_t count) {
  return withWorlds(worlds, [&](Worlds& w) -> Result<void> {
    const auto known = arrayOf(array);
    if (!known) return refusal("an array is PB_PERCEPTS, PB_ROBOTS or PB_GAME");
    return w.read(*known, spanOf(out, count));
  });
}

pb_status pb_read_boards(pb_worlds* worlds, std::uint32_t* out, size_t count) {
  return withWorlds(worlds, [&](Worlds& w) { return w.readBoards(spanOf(out, count)); });
}

pb_status pb_read_hashes(pb_worlds* worlds, std::uint64_t* out, size_t count) {
  return withWorlds(worlds, [&](Worlds& w) { return w.readHashes(spanOf(out, count)); });
}

pb_status pb_find_variable(const char* name, std::int32_t* variable) {
  return guarded([&] {
    if (name == nullptr || variable == nullptr) return missing("name and variable");
    const auto found = worldVariable(name);
    if (!found) return reportStatus(tl::unexpected(found.error()));
    *variable = found->index + (found->type == VariableType::Float ? firstFloat : 0);
    return reportStatus(PB_OK, "");
  });
}

pb_status pb_read_variables(pb_worlds* worlds, const std::int32_t* variables, size_t variable_count,
                            double* out, size_t count) {
  return withWorlds(worlds, [&](Worlds& w) -> Result<void> {
    const auto known = TRY(variablesOf(variables, variable_count));
    return w.readVariables(known, spanOf(out, count));
  });
}

pb_status pb_write_variables(pb_worlds* worlds, const std::int32_t* variables,
                             size_t variable_count, const double* values, size_t count) {
  return withWorlds(worlds, [&](Worlds& w) -> Result<void> {
    const auto known = TRY(variablesOf(variables, variable_count));
    return w.writeVariables(known, spanOf(values, count));
  });
}

pb_status pb_write_commands(pb_worlds* worlds, const std::int32_t* commands, size_t count) {
  return withWorlds(worlds, [&](Worlds& w) { return w.writeCommands(spanOf(commands, count)); });
}

pb_status pb_write_actions(pb_worlds* worlds, const std::int32_t* actions, size_t count) {
  return withWorlds(worlds, [&](Worlds& w) { return w.writeActions(spanOf(actions, count)); });
}

pb_status pb_place_robot(pb_worlds* worlds, std::int32_t world, std::int32_t robot, double x,
                         double y, double yaw) {
  return withWorlds(worlds, [&](Worlds& w) {
    return w.placeRobot(world, RobotId{robot}, {{x, y}, yaw});
  });
}

pb_status pb_place_ball(pb_worlds* worlds, std::int32_t world, double x, double y,
                        double velocity_x, double velocity_y) {
  return withWorlds(worlds, [&](Worlds& w) {
    return w.placeBall(world, {x, y}, {velocity_x, velocity_y});
  });
}

pb_status pb_take_snapshot(pb_worlds* worlds, std::int32_t world, pb_snapshot** snapshot) {
  if (snapshot == nullptr) return missing("snapshot");
  *snapshot = nullptr;
  return withWorlds(worlds, [&](Worlds& w) -> Result<void> {
    auto taken = TRY(w.snapshot(world));
    *snapshot = snapshotHandles().add(std::make_shared<const WorldSnapshot>(std::move(taken)));
    return {};
  });
}

pb_status pb_restore(pb_worlds* worlds, std::int32_t world, const pb_snapshot* snapshot) {
  return guarded([&] {
    if (snapshot == nullptr) return missing("snapshot");
    const auto found = snapshotHandles().find(snapshot);
    if (!found)
      return reportStatus(PB_STALE_HANDLE,
                          "this snapshot does not exist: it was destroyed or never taken");
    return withWorlds(worlds, [&](Worlds& w) { return w.restore(world, *found); });
  });
}

pb_status pb_destroy_snapshot(pb_snapshot* snapshot) {
  return guarded([&] {
    if (snapshot == nullptr || snapshotHandles().remove(snapshot)) return reportStatus(PB_OK, "");
    return reportStatus(PB_STALE_HANDLE, "this snapshot was destroyed before");
  });
}

pb_status pb_reset_some(pb_worlds* worlds, const std::int32_t* which, const std::uint64_t* seeds,
                        size_t count) {
  return withWorlds(worlds,
                    [&](Worlds& w) { return w.reset(spanOf(which, count), spanOf(seeds, count)); });
}

pb_status pb_restore_seeded(pb_worlds* worlds, const std::int32_t* which,
                            const std::uint64_t* seeds, size_t count, const pb_snapshot* snapshot) {
  return guarded([&] {
    if (snapshot == nullptr) return missing("snapshot");
    const auto found = snapshotHandles().find(snapshot);
    if (!found)
      return reportStatus(PB_STALE_HANDLE,
                          "this snapshot does not exist: it was destroyed or never taken");
    return withWorlds(worlds, [&](Worlds& w) {
      return w.restore(spanOf(which, count), spanOf(seeds, count), *found);
    });
  });
}

pb_status pb_place_robots(pb_worlds* worlds, const std::int32_t* which, size_t count,
                          std::int32_t robot, const double* poses) {
  return withWorlds(worlds, [&](Worlds& w) -> Result<void> {
    if (poses == nullptr) return refusal("poses must not be null");
    std::vector<Pose> places;
    for (size_t i = 0; i < count; ++i) {
      places.push_back({{poses[3 * i], poses[3 * i + 1]}, poses[3 * i + 2]});
    }
    return w.placeRobots(spanOf(which, count), RobotId{robot}, places);
  });
}

pb_status pb_place_balls(pb_worlds* worlds, const std::int32_t* which, size_t count,
                         const double* balls) {
  return withWorlds(worlds, [&](Worlds& w) -> Result<void> {
    if (balls == nullptr) return refusal("balls must not be null");
    std::vector<Point> places;
    std::vector<Velocity> velocities;
    for (size_t i = 0; i < count; ++i) {
      places.push_back({balls[4 * i], balls[4 * i + 1]});
      velocities.push_back({balls[4 * i + 2], balls[4 * i + 3]});
    }
    return w.placeBalls(spanOf(which, count), places, velocities);
  });
}

pb_status pb_rollout_options_init(pb_rollout_options* options, size_t size) {
  pb_rollout_options usual{};
  usual.threads = 1;
  usual.tick_rate = rollout::Setup{}.tickRate;
  return initialized(options, size, usual, "pb_rollout_options");
}

pb_status pb_play_options_init(pb_play_options* options, size_t size) {
  pb_play_options usual{};
  usual.seconds = rollout::PlayOptions{}.seconds;
  usual.look = rollout::PlayOptions{}.look;
  return initialized(options, size, usual, "pb_play_options");
}

pb_status pb_rollouts_create(const pb_rollout_options* options, pb_rollouts** rollouts) {
  return guarded([&] {
    if (rollouts == nullptr) return missing("rollouts");
    *rollouts = nullptr;
    if (options == nullptr) return missing("options");
    if (options->size != sizeof(pb_rollout_options)) {
      return reportStatus(PB_INVALID_ARGUMENT,
                          "call pb_rollout_options_init() on these options first");
    }
    const auto made = [&]() -> Result<std::shared_ptr<LockedRollouts>> {
      Scenario scenario = TRY(scenarioOf(options->scenario, options->text, "match"));
      scenario = TRY(changed(std::move(scenario), {{}, textOf(options->noise), {}, 0.0}));
      RolloutStart start = rolloutStartOf(scenario, options->tick_rate);
      auto all = TRY(rollout::Rollouts::create(start.setup, {options->threads, 1}));
      return std::make_shared<LockedRollouts>(std::move(all), std::move(start.belief));
    }();
    if (!made) return reportStatus(tl::unexpected(made.error()));
    *rollouts = rolloutHandles().add(*made);
    return reportStatus(PB_OK, "");
  });
}

pb_status pb_rollouts_destroy(pb_rollouts* rollouts) {
  return destroyHandle(rolloutHandles(), rollouts, "rollouts");
}

pb_status pb_rollouts_robots(pb_rollouts* rollouts, std::int32_t* robots) {
  return withRollouts(rollouts, [&](LockedRollouts& r) -> Result<void> {
    if (robots == nullptr) return refusal("robots must not be null");
    *robots = static_cast<std::int32_t>(r.rollouts.players());
    return {};
  });
}

pb_status pb_rollouts_beginning(pb_rollouts* rollouts, double* robots, size_t robot_count,
                                double* game, size_t game_count) {
  return withRollouts(rollouts, [&](LockedRollouts& r) {
    return writeBelief(r.beginning, spanOf(robots, robot_count), spanOf(game, game_count));
  });
}

pb_status pb_rollouts_play(pb_rollouts* rollouts, const pb_play_options* options,
                           const double* robots, size_t robot_count, const double* game,
                           size_t game_count, const std::uint64_t* seeds, size_t seed_count,
                           double* outcomes, size_t outcome_count) {
  return withRollouts(rollouts, [&](LockedRollouts& r) -> Result<void> {
    if (options == nullptr) return refusal("options must not be null");
    if (options->size != sizeof(pb_play_options)) {
      return refusal("call pb_play_options_init() on these options first");
    }
    const auto belief =
        TRY(readBelief(r.beginning, spanOf(robots, robot_count), spanOf(game, game_count)));
    return r.rollouts.play(belief, spanOf(seeds, seed_count),
                           {options->seconds, options->look, options->go_on != 0},
                           spanOf(outcomes, outcome_count));
  });
}
