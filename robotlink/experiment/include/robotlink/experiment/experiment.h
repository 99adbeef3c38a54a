// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// An experiment: a scenario, what is varied in it, how often it is played, what is measured and
// what must hold. A JSON file (docs/experiments.md); a situation test is a small one with
// assertions, a tournament is one whose conditions are matches between teams. Here it is expanded:
// conditions and grids are a list of scenarios, runs have numbers. Plain values; any thread.
// Metres, seconds, degrees in settings as in the file.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <robotlink/scenario/scenario.h>

namespace pitchboard::link {

/// A value for a key of the scenario: "noise.forward", "robots[B1].behaviour", "robots[*].model".
struct ScenarioSetting {
  std::string key;
  std::string value;  ///< JSON
  int line = 1;
  bool operator==(const ScenarioSetting&) const = default;
};

/// A number drawn anew for every run, uniform in [from, to].
struct RandomSetting {
  std::string key;
  double from = 0.0, to = 0.0;
  int line = 1;
  bool operator==(const RandomSetting&) const = default;
};

/// How far a run's start is from the scenario's: uniform within ± these.
struct StartSpread {
  std::string who;  ///< "ball", "robots" (all of them), or a name: "B1"
  double x = 0.0, y = 0.0;
  double heading = 0.0;  ///< degrees
  bool operator==(const StartSpread&) const = default;
};

/// Somebody puts the ball or a robot somewhere else during the run.
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
  Scenario scenario;                 ///< with the settings; without stop conditions
  std::string json;                  ///< the same as text, for what is drawn for each run
  std::vector<PlacedByHand> placed;  ///< the experiment's and its own, in order of time
  TeamColor team = TeamColor::Blue;  ///< whose values its runs have
  bool teamPrograms = false;         ///< a team's own programs play, too
};

/// The first that is met ends a run.
struct RunStop {
  double duration = 600.0;
  bool goal = false;         ///< of the team
  bool goalAgainst = false;  ///< of its opponents
  bool ballOut = false;
  bool fell = false;            ///< a robot of the team
  std::optional<double> stuck;  ///< for so long neither the ball nor a robot of the team moved
  bool operator==(const RunStop&) const = default;
};

/// How the values of an expression over a run become one.
enum class Reduction : std::uint8_t {
  Mean,
  Least,
  Most,
  First,
  Last,
  Sum,      ///< over time: the integral, unit x s
  Changes,  ///< how often it became true
  P95
};

struct ExpressionMetric {
  std::string name, unit, expression;
  Reduction reduction = Reduction::Mean;
  bool operator==(const ExpressionMetric&) const = default;
};

/// A given figure, of a robot or a paper, to compare with.
struct GivenFigure {
  std::string name, metric;
  double mean = 0.0;
  std::optional<double> deviation;  ///< left out: a rate
  std::size_t count = 0;
  std::vector<std::string> conditions;  ///< compared with these; empty: all
};

struct Assertion {
  std::string text;       ///< "goal_rate >= 0.5"
  std::string condition;  ///< empty: it must hold in every condition
  int line = 1;
  bool operator==(const Assertion&) const = default;
};

/// A team of a tournament: what is different in the scenario when it plays.
struct TournamentTeam {
  /// For a key of a robot: "behaviour", "behaviour.takes_ball", "model".
  struct Setting {
    int shirt = 0;  ///< 0: all of its robots
    ScenarioSetting setting;
    bool operator==(const Setting&) const = default;
  };
  std::string name;
  int number = 0;               ///< the referee's; 0: that of its colour
  std::string runtime;          ///< as runtimeChoiceToText() writes it; empty: the scenario's
  std::vector<Setting> robots;  ///< a later one wins
  int line = 1;
  bool operator==(const TournamentTeam&) const = default;
};

/// Two teams that play each other: indices. The first one plays blue first.
struct Pairing {
  std::size_t first = 0, second = 1;
  bool operator==(const Pairing&) const = default;
};

/// What must hold of a team's matches: "low95(goal_difference) > 0".
struct TeamAssertion {
  std::string text;
  std::size_t team = 0;
  std::optional<std::size_t> opponent{};  ///< nothing: against everybody
  int line = 1;
  bool operator==(const TeamAssertion&) const = default;
};

/// Matches between teams. Each pairing is a condition of the experiment, or two of them, one behind
/// the other, with the sides swapped. The values of a match are those of the first of its pairing.
struct Tournament {
  std::vector<TournamentTeam> teams;
  std::vector<Pairing> pairings;
  bool swapSides = true;
  bool wholeMatches = false;  ///< a match without a final whistle is wrong
  std::vector<TeamAssertion> assertions;
  bool operator==(const Tournament&) const = default;
};

enum class Record : std::uint8_t { Nothing, Failed, All, Chosen };

struct Experiment {
  std::string name = "untitled", title, description;
  std::uint64_t seed = 1;
  std::size_t runs = 1;              ///< of each condition
  bool commonSeeds = true;           ///< run i has the same seed in every condition
  TeamColor team = TeamColor::Blue;  ///< whose experiment it is; a condition may be another's
  std::vector<Condition> conditions;
  std::vector<RandomSetting> random;
  std::vector<StartSpread> starts;
  std::vector<PlacedByHand> placed;  ///< in every condition
  RunStop stop;
  std::vector<ExpressionMetric> metrics;
  double sampleEvery = 0.1;      ///< s, for expressions, beliefs and possession
  std::string success = "goal";  ///< over a run's metrics: what is a good run
  std::vector<GivenFigure> given;
  std::vector<Assertion> assertions;
  Record record = Record::Nothing;
  std::vector<std::size_t> recorded;       ///< numbers of runs, with Record::Chosen
  bool separateProcesses = false;          ///< reference processes as programs, in lock-step
  double speed = 10.0;                     ///< times real time of runs with own programs, at most
  std::size_t pathsShown = 30;             ///< runs of a condition that the report draws
  std::optional<Tournament> tournament{};  ///< whose matches the conditions are
  std::string text;  ///< the file with its scenario inside: what a results folder keeps

  std::size_t allRuns() const { return runs * conditions.size(); }
  bool hasTeamPrograms() const { return std::ranges::any_of(conditions, &Condition::teamPrograms); }
};

/// Which run a number is; numbers go from 1 to allRuns().
struct RunPlace {
  std::size_t number = 1, condition = 0, index = 0;
};
/// It wants this run in a session file.
bool isRecorded(const Experiment& experiment, std::size_t number, bool success);
RunPlace placeOf(const Experiment& experiment, std::size_t number);
std::uint64_t seedOf(const Experiment& experiment, const RunPlace& run);

/// What is different from the file, as a command line says it.
struct ExperimentChanges {
  std::optional<std::uint64_t> seed;
  std::optional<std::size_t> runs;       ///< of each condition
  std::optional<std::size_t> matches{};  ///< of each pairing of a tournament
};

struct ExperimentName {
  std::string name, title;
};
/// resources/experiments and resources/situations.
std::vector<ExperimentName> builtInExperiments();
std::vector<ExperimentName> builtInSituations();

/// A built-in name, or else a path. Errors give file, line and key: "my.json:14:
/// conditions[1].set.noise: there is no noise preset ...".
Result<Experiment> loadExperiment(const std::string& nameOrPath,
                                  const ExperimentChanges& changes = {});
/// `folder`: where the file's scenario is looked for.
Result<Experiment> experimentFromJson(std::string_view text, std::string_view source,
                                      const std::string& folder = {},
                                      const ExperimentChanges& changes = {});

/// The scenario of one run: its seed, what is drawn for it, its start. Fails where a drawn value
/// cannot be used.
Result<Scenario> scenarioOf(const Experiment& experiment, const RunPlace& run);

}  // namespace pitchboard::link
