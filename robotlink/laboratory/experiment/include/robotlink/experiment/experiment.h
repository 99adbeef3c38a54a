// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// An experiment plays a scenario many times. Its JSON file (docs/experiments.md) says what is
// varied between conditions, how often each is played, what is measured, and which assertions must
// hold. A situation test is a small experiment with assertions; a tournament is one whose
// conditions are matches between teams. The types below hold an expanded experiment: conditions and
// grids have become a list of scenarios, and each run has a number. Plain values; any thread.
// Metres and seconds; angles are in degrees, as in the file.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <robotlink/scenario/scenario.h>
#include <telemetry/query/rules.h>

namespace pitchboard::link {

/// Sets a key of the scenario, such as "noise.forward", "robots[B1].behaviour" or
/// "robots[*].model".
struct ScenarioSetting {
  std::string key;
  std::string value;  ///< JSON
  int line = 1;
  bool operator==(const ScenarioSetting&) const = default;
};

/// A number that is drawn for each run, uniform in [from, to].
struct RandomSetting {
  std::string key;
  double from = 0.0, to = 0.0;
  int line = 1;
  bool operator==(const RandomSetting&) const = default;
};

/// By how much the start of a run differs from the scenario's: uniform within ± these values.
struct StartSpread {
  std::string who;  ///< "ball", "robots" (all of them), or a robot's name, such as "B1"
  double x = 0.0, y = 0.0;
  double heading = 0.0;  ///< degrees
  bool operator==(const StartSpread&) const = default;
};

/// Moves the ball or a robot during the run.
struct PlacedByHand {
  double time = 0.0;
  std::string who;  ///< "ball" or a robot's name
  Pose pose;
  Velocity velocity;  ///< of the ball
  bool operator==(const PlacedByHand&) const = default;
};

struct Condition {
  std::string name;
  std::vector<ScenarioSetting> settings;
  Scenario scenario;                 ///< with the settings applied; without stop conditions
  std::string json;                  ///< the same as text, in which numbers are drawn for each run
  std::vector<PlacedByHand> placed;  ///< those of the experiment and its own, in order of time
  TeamColor team = TeamColor::Blue;  ///< the team whose metrics are measured
  bool teamPrograms = false;         ///< team programs take part
};

/// Conditions that end a run; the first that is met ends it.
struct RunStop {
  double duration = 600.0;
  bool goal = false;         ///< the team scored
  bool goalAgainst = false;  ///< its opponents scored
  bool ballOut = false;
  bool fell = false;            ///< a robot of the team fell
  std::optional<double> stuck;  ///< neither the ball nor a robot of the team moved for this time
  bool operator==(const RunStop&) const = default;
};

/// How the values of an expression during a run are reduced to one number.
enum class Reduction : std::uint8_t {
  Mean,
  Least,
  Most,
  First,
  Last,
  Sum,      ///< integral over time, in unit x s
  Changes,  ///< how often the expression became true
  P95
};

struct ExpressionMetric {
  std::string name, unit, expression;
  Reduction reduction = Reduction::Mean;
  bool operator==(const ExpressionMetric&) const = default;
};

/// A figure from elsewhere, such as a real robot or a paper, to compare results with.
struct GivenFigure {
  std::string name, metric;
  double mean = 0.0;
  std::optional<double> deviation;  ///< empty: the figure is a rate
  std::size_t count = 0;
  std::vector<std::string> conditions;  ///< conditions to compare with; empty: all
};

struct Assertion {
  std::string text;       ///< "goal_rate >= 0.5"
  std::string condition;  ///< empty: it must hold in every condition
  int line = 1;
  bool operator==(const Assertion&) const = default;
};

/// A team of a tournament: the changes to the scenario when it plays.
struct TournamentTeam {
  /// Sets a key of a robot, such as "behaviour", "behaviour.takes_ball" or "model".
  struct Setting {
    int shirt = 0;  ///< 0: all of its robots
    ScenarioSetting setting;
    bool operator==(const Setting&) const = default;
  };
  std::string name;
  int number = 0;               ///< its number at the referee; 0: that of its colour
  std::string runtime;          ///< as runtimeChoiceToText() writes it; empty: the scenario's
  std::string advisor;          ///< JSON, as for a team of a scenario; empty: none
  std::vector<Setting> robots;  ///< later settings override earlier ones
  int line = 1;
  bool operator==(const TournamentTeam&) const = default;
};

/// Two teams that play each other, by index. `first` starts as blue.
struct Pairing {
  std::size_t first = 0, second = 1;
  bool operator==(const Pairing&) const = default;
};

/// What must hold for a team's matches: "low95(goal_difference) > 0".
struct TeamAssertion {
  std::string text;
  std::size_t team = 0;
  std::optional<std::size_t> opponent{};  ///< empty: all opponents
  int line = 1;
  bool operator==(const TeamAssertion&) const = default;
};

/// Matches between teams. Each pairing is one condition of the experiment, or with swapSides two
/// successive ones. The metrics of a match are those of the first team of its pairing.
struct Tournament {
  std::vector<TournamentTeam> teams;
  std::vector<Pairing> pairings;
  bool swapSides = true;
  bool wholeMatches = false;  ///< a match must end with the final whistle
  std::vector<TeamAssertion> assertions;
  bool operator==(const Tournament&) const = default;
};

enum class Record : std::uint8_t { Nothing, Failed, All, Chosen };

struct Experiment {
  std::string name = "untitled", title, description;
  std::uint64_t seed = 1;
  std::size_t runs = 1;              ///< for each condition
  bool commonSeeds = true;           ///< run i has the same seed in every condition
  TeamColor team = TeamColor::Blue;  ///< the team whose metrics are measured; conditions may differ
  std::vector<Condition> conditions;
  std::vector<RandomSetting> random;
  std::vector<StartSpread> starts;
  std::vector<PlacedByHand> placed;  ///< in every condition
  RunStop stop;
  std::vector<ExpressionMetric> metrics;
  double sampleEvery = 0.1;      ///< s, for expressions, beliefs and possession
  std::string success = "goal";  ///< expression over a run's metrics: true for a successful run
  std::vector<GivenFigure> given;
  std::vector<telemetry::Rule> rules{};  ///< metrics rule_NAME; errors are assertions, too
  std::vector<Assertion> assertions;
  Record record = Record::Nothing;
  std::vector<std::size_t> recorded;       ///< numbers of runs, for Record::Chosen
  bool separateProcesses = false;          ///< reference processes are separate, in lock-step
  double speed = 10.0;                     ///< highest speed of runs with team programs
  std::size_t pathsShown = 30;             ///< runs per condition that the report draws
  std::optional<Tournament> tournament{};  ///< set if the conditions are its matches
  std::string text;  ///< the file with its scenario included, as a results folder keeps it

  std::size_t allRuns() const { return runs * conditions.size(); }
  bool hasTeamPrograms() const { return std::ranges::any_of(conditions, &Condition::teamPrograms); }
};

/// A run: its number, from 1 to allRuns(), and the condition and index in it that follow from it.
struct RunPlace {
  std::size_t number = 1, condition = 0, index = 0;
};
/// Returns whether the experiment records this run in a session file.
bool isRecorded(const Experiment& experiment, std::size_t number, bool success);
RunPlace placeOf(const Experiment& experiment, std::size_t number);
std::uint64_t seedOf(const Experiment& experiment, const RunPlace& run);

/// Values of the command line that replace those of the file.
struct ExperimentChanges {
  std::optional<std::uint64_t> seed;
  std::optional<std::size_t> runs;       ///< for each condition
  std::optional<std::size_t> matches{};  ///< for each pairing of a tournament
  std::vector<std::string> advised{};    ///< names of the tournament's teams with an advisor
};

struct ExperimentName {
  std::string name, title;
};
// The files in resources/experiments and resources/situations.
std::vector<ExperimentName> builtInExperiments();
std::vector<ExperimentName> builtInSituations();

/// Loads a built-in experiment or a file. Errors name file, line and key: "my.json:14:
/// conditions[1].set.noise: there is no noise preset ...".
Result<Experiment> loadExperiment(const std::string& nameOrPath,
                                  const ExperimentChanges& changes = {});
/// Paths of scenarios in the text are relative to `folder`.
Result<Experiment> experimentFromJson(std::string_view text, std::string_view source,
                                      const std::string& folder = {},
                                      const ExperimentChanges& changes = {});

/// Returns the scenario of a run, with its seed, drawn numbers and start. Fails if a drawn number
/// is not valid.
Result<Scenario> scenarioOf(const Experiment& experiment, const RunPlace& run);

}  // namespace pitchboard::link
