// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A scenario: everything that a simulated match starts from. A JSON file (docs/scenarios.md) with
// poses in metres and degrees; here in metres and radians.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <base/result.h>
#include <robotlink/blackboard/variable_catalog.h>
#include <robotlink/cognition/behaviour_parameters.h>
#include <robotlink/models/noise_presets.h>
#include <robotlink/processes/runtime_profile.h>
#include <simcore/simulation/simulation.h>

namespace pitchboard::link {

/// A value for a blackboard variable, by name; the type is the catalog's.
struct BlackboardWrite {
  RobotId robot;  ///< 0 = every robot
  std::string variable;
  double value = 0.0;  ///< exact for every int32 and float32
  double time = 0.0;   ///< simulated s; written before the tick that starts then
  bool operator==(const BlackboardWrite&) const = default;
};

/// Behaviour of a robot without a decision process: for a team's own process, or an obstacle.
constexpr std::string_view noBehaviour = "none";

/// Where a robot believes that it is.
struct ScenarioBelief {
  Pose pose;
  double sigma = 0.0;  ///< m, spread of its particles
  bool operator==(const ScenarioBelief&) const = default;
};

struct ScenarioRobot {
  sim::RobotIdentity identity;
  Pose pose;
  std::string behaviour = "striker";  ///< a name of behaviours(), or noBehaviour
  RuntimeChoice runtime{};            ///< who runs; not chosen: as its team
  sim::RobotModel model{};
  BehaviourParameters parameters{};        ///< of its behaviour
  std::optional<ScenarioBelief> belief{};  ///< nothing: it has to find out
  bool operator==(const ScenarioRobot&) const = default;
};

/// A run ends when any of these is met; none set = it goes on.
struct StopConditions {
  std::optional<double> duration;  ///< simulated s
  bool goal = false;
  bool ballOut = false;
  bool operator==(const StopConditions&) const = default;
};

struct Scenario {
  std::string name = "untitled";  ///< short, for --scenario and files
  std::string title;              ///< for people
  std::string description;
  sim::SimulationSettings settings;
  std::vector<ScenarioRobot> robots;
  Point ball;
  Velocity ballVelocity;
  bool clockRunning = true;
  double clock = 0.0;  ///< s of play so far, at least 0
  sim::Score score;
  /// With a referee: where in a game it begins, with clock and score. Nothing: before the match.
  std::optional<sim::GameStart> game{};
  std::vector<BlackboardWrite> writes;  ///< in order of time
  StopConditions stop;
  std::map<TeamColor, RuntimeChoice> runtimes;  ///< of teams; left out: as the match is played
  /// What is said of this robot, or of its team; not chosen: nothing.
  RuntimeChoice runtimeOf(const ScenarioRobot& robot) const;
  /// The same for a robot of a team of which `own` is said.
  RuntimeChoice runtimeOf(TeamColor team, const RuntimeChoice& own) const;
  bool operator==(const Scenario&) const = default;
};

/// What the caller wants to be different in a scenario.
struct ScenarioOverrides {
  std::optional<std::uint64_t> seed;
  std::string noise;      ///< name of a preset; empty: the scenario's
  std::string physics;    ///< name of a model; empty: the scenario's
  double duration = 0.0;  ///< s; 0: the scenario's
};
/// Errors as noisePreset(); InvalidArgument for a duration below 0 or above 1e9 s.
Result<Scenario> changed(Scenario scenario, const ScenarioOverrides& overrides);

struct ScenarioName {
  std::string name;
  std::string title;
};
/// Built-in scenarios, the default (match) first.
std::vector<ScenarioName> builtInScenarios();

/// A built-in name, or else a path. Errors give file, line and the path of the offending key:
/// "my.json:14: robots[2].x: must be a number in metres". `catalog` names the variables that
/// scripted writes may use.
Result<Scenario> loadScenario(const std::string& nameOrPath,
                              const VariableCatalog& catalog = VariableCatalog::published());
Result<Scenario> scenarioFromJson(std::string_view text, std::string_view source,
                                  const VariableCatalog& catalog = VariableCatalog::published());
/// The same form. Reading it gives an equal scenario when that came from a file; an angle of any
/// other origin may come back one unit in the last place away, and then stays.
std::string scenarioToJson(const Scenario& scenario);

}  // namespace pitchboard::link
