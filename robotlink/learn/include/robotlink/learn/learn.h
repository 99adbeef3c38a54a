// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Learns: plays generation after generation of candidates, lets the last means and the best points
// play for the choice, and the one that is chosen against the opponents of the validation, once.
// All of it is in a folder, from which an interrupted learning continues; several programs may
// share the work in one folder. What is learned depends on the file only: not on threads, shards
// or interruptions. One thread, which starts those that play.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <base/result.h>
#include <robotlink/experiment/experiment_summary.h>
#include <robotlink/experiment/run_player.h>
#include <robotlink/learn/cma_search.h>
#include <robotlink/learn/learning.h>

namespace pitchboard::link {

struct LearnSettings {
  /// learn.json (the file with its scenario inside), journal.jsonl (a line for each generation),
  /// a folder of results for each generation, round of the choice and the validation; at the end
  /// curve.csv, best.json, report.html and junit.xml.
  std::string folder;
  std::size_t shard = 1, shards = 1, jobs = 1;
  bool resume = false;
  PlaySettings play{};
  std::string program{};  ///< name and version, for files
  /// How far it is, for people: "generation 3 of 60: 417 of 640 matches". Empty: tell nobody.
  std::function<void(const std::string&)> progress{};
};

struct LearnedTeam {
  std::string from;            ///< "mean of generation 58"
  std::vector<double> values;  ///< by parameter
  std::vector<Generation> generations;
  std::vector<std::vector<double>> means;  ///< after each generation, as shares of the ranges
  double objective = 0.0;                  ///< its mean in the choice
  double objectiveOfStart = 0.0;           ///< in the same matches, as far as the start came
  std::size_t choosingMatches = 0;         ///< against each opponent
  Experiment validation;
  ExperimentSummary summary;  ///< of the validation
};

/// Error Conflict for a folder of another learning, for one that is not resumed, and when it was
/// interrupted. All shards return the same; the first one writes the files.
Result<LearnedTeam> learn(const Learning& learning, const LearnSettings& settings);

/// The text of best.json: what loadBehaviourParameters() reads.
std::string bestJson(const Learning& learning, const LearnedTeam& team, const std::string& program);
/// A line for each generation.
std::string curveCsv(const Learning& learning, const LearnedTeam& team);
std::string learnReportHtml(const Learning& learning, const LearnedTeam& team,
                            const std::string& program);

}  // namespace pitchboard::link
