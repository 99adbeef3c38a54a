// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads the file of an experiment: what stands in it goes into an Experiment, whose conditions are
// then made by expanding (experiment.cpp). One use.

#include <robotlink/experiment/experiment.h>

#include "scenario_patch.h"

namespace pitchboard::link {

/// What conditions are made of.
// NOLINTNEXTLINE(bugprone-exception-escape): an empty Json allocates nothing.
struct ConditionParts {
  Json scenario;
  StopConditions stop;  ///< of the scenario
  std::vector<ScenarioSetting> common;
  struct Named {
    std::string name;
    std::vector<ScenarioSetting> settings;
    std::vector<PlacedByHand> placed;
    int line = 1;
    std::optional<TeamColor> team{};  ///< nothing: the experiment's
  };
  std::vector<Named> named;
  struct Axis {
    std::string key;
    std::vector<std::string> values;  ///< JSON
    int line = 1;
  };
  std::vector<Axis> grid;
};

class ExperimentReader {
 public:
  ExperimentReader(const JsonNode& root, JsonReport& report, std::string folder);
  /// Everything but conditions. The first error is in the report.
  void read(Experiment& experiment, ConditionParts& parts);
  /// `matches`: of each pairing of a tournament; 0: it is none.
  std::size_t matches() const { return m_matches; }

 private:
  void readScenario(ConditionParts& parts);
  void readConditions(ConditionParts& parts);
  void readRandom(Experiment& experiment);
  void readStarts(Experiment& experiment);
  void readStop(Experiment& experiment, const StopConditions& usual);
  void readMetrics(Experiment& experiment);
  void readGiven(Experiment& experiment);
  void readRules(Experiment& experiment);
  void readAssertions(Experiment& experiment);
  void readRecord(Experiment& experiment);
  void readTournament(Experiment& experiment);
  void readTeam(const JsonNode& node, std::size_t index, Tournament& tournament);
  void readPairings(Tournament& tournament);
  void readTeamAssertions(Tournament& tournament);
  std::optional<std::size_t> teamNamed(const JsonObject& object, std::string_view key,
                                       const Tournament& tournament) const;
  std::string pathOf(const std::string& name) const;
  std::vector<PlacedByHand> placedOf(const JsonObject& object);
  std::vector<ScenarioSetting> settingsOf(const JsonNode& node, const std::string& path);

  JsonReport& m_report;
  JsonObject m_root;
  std::string m_folder;
  std::size_t m_matches = 0;
};

}  // namespace pitchboard::link
