// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A scenario describes how a simulated match starts. It is a JSON file (docs/scenarios.md) in
// metres and degrees; these values are in metres and radians. Plain values; any thread.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <base/result.h>
#include <robotlink/blackboard/variable_catalog.h>
#include <robotlink/cognition/cognitive_process.h>
#include <robotlink/models/noise_presets.h>
#include <robotlink/processes/runtime_profile.h>
#include <simcore/simulation/simulation.h>

namespace pitchboard::link {

/// A value for a blackboard variable by name. The catalog decides its type.
struct BlackboardWrite {
  RobotId robot;  ///< 0: every robot
  std::string variable;
  double value = 0.0;  ///< exact for every int32 and float32
  double time = 0.0;   ///< simulated time in s; written before the tick that starts then
  bool operator==(const BlackboardWrite&) const = default;
};

/// The behaviour of a robot without a decision process: a team's program decides, or nobody.
constexpr std::string_view noBehaviour = "none";

/// Where a robot believes to be.
struct ScenarioBelief {
  Pose pose;
  double sigma = 0.0;  ///< m, standard deviation of its particles
  bool operator==(const ScenarioBelief&) const = default;
};

struct ScenarioRobot {
  sim::RobotIdentity identity;
  Pose pose;
  std::string behaviour = "striker";  ///< a name of behaviours(), or noBehaviour
  RuntimeChoice runtime{};            ///< its runtime; if not chosen, that of its team
  sim::RobotModel model{};
  BehaviourParameters parameters{};        ///< numbers of its behaviour
  std::optional<ScenarioBelief> belief{};  ///< empty: the robot has to localize itself
  bool operator==(const ScenarioRobot&) const = default;
};

/// A match ends when any of these is met. If none is set, it continues.
struct StopConditions {
  std::optional<double> duration;  ///< simulated time in s
  bool goal = false;
  bool ballOut = false;
  bool operator==(const StopConditions&) const = default;
};

struct Scenario {
  std::string name = "untitled";  ///< short name, for --scenario and files
  std::string title;              ///< for people
  std::string description;
  sim::SimulationSettings settings;
  std::vector<ScenarioRobot> robots;
  Point ball;
  Velocity ballVelocity;
  bool clockRunning = true;
  double clock = 0.0;  ///< s played so far, at least 0
  sim::Score score;
  /// With a referee: where in a game the match starts; empty: at its beginning.
  std::optional<sim::GameStart> game{};
  std::vector<BlackboardWrite> writes;  ///< in order of time
  StopConditions stop;
  std::map<TeamColor, RuntimeChoice> runtimes;  ///< of teams; missing: as the match is played
  /// Of teams whose keeper learns where the opponents aim (docs/advisor.md).
  std::map<TeamColor, AdvisorOptions> advisors{};
  /// Returns the runtime of this robot or of its team; may be not chosen.
  RuntimeChoice runtimeOf(const ScenarioRobot& robot) const;
  /// Returns the same for a robot of `team` whose own choice is `own`.
  RuntimeChoice runtimeOf(TeamColor team, const RuntimeChoice& own) const;
  /// Returns the index of the robot that is called so; fails with the names that there are.
  Result<std::size_t> robotNamed(std::string_view name) const;
  bool operator==(const Scenario&) const = default;
};

/// Changes that changed() makes to a scenario.
struct ScenarioOverrides {
  std::optional<std::uint64_t> seed;
  std::string noise;      ///< name of a preset; empty: as in the scenario
  std::string physics;    ///< name of a model; empty: as in the scenario
  double duration = 0.0;  ///< s; 0: as in the scenario
};
/// Fails as noisePreset() does, and with InvalidArgument for a duration below 0 or above 1e9 s.
Result<Scenario> changed(Scenario scenario, const ScenarioOverrides& overrides);

struct ScenarioName {
  std::string name;
  std::string title;
};
/// Returns the built-in scenarios, the default first.
std::vector<ScenarioName> builtInScenarios();

/// Loads a built-in name, or else a file. Errors give file, line and path of the key:
/// "my.json:14: robots[2].x: must be a number in metres". `catalog` names the variables that
/// scripted writes may use.
Result<Scenario> loadScenario(const std::string& nameOrPath,
                              const VariableCatalog& catalog = VariableCatalog::published());
Result<Scenario> scenarioFromJson(std::string_view text, std::string_view source,
                                  const VariableCatalog& catalog = VariableCatalog::published());
/// Returns the scenario as JSON, which reads back to an equal one if it came from a file. Other
/// angles may differ once in the last place.
std::string scenarioToJson(const Scenario& scenario);

}  // namespace pitchboard::link
