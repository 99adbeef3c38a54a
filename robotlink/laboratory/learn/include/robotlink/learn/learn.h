// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Learns the parameters of a team. It plays generations of candidates, then chooses between the
// last means and the best points in further matches, and at last plays the chosen team once against
// the opponents of the validation. Everything is kept in a folder, in which an interrupted learning
// continues; several programs may share the work in one folder. The result depends only on the
// file, not on threads, shards or interruptions. Call it on one thread; it starts the threads that
// play.

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
  /// Contains learn.json (the file with its scenario included), journal.jsonl (a line for each
  /// generation), and a folder of results for each generation, each round of the choice and the
  /// validation; at the end also curve.csv, best.json, report.html and junit.xml.
  std::string folder;
  std::size_t shard = 1, shards = 1, jobs = 1;
  bool resume = false;
  PlaySettings play{};
  std::string program{};  ///< name and version, for files
  /// Called with the progress, such as "generation 3 of 60: 417 of 640 matches"; may be empty.
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

/// Error Conflict if the folder belongs to another learning, if it is not empty without `resume`,
/// or if the learning was interrupted. All shards return the same result; the first one writes the
/// files.
Result<LearnedTeam> learn(const Learning& learning, const LearnSettings& settings);

/// Removes what was learned in a folder, with its results and reports, and nothing else that is
/// there. Does nothing if nothing was learned there. Error Conflict while another program learns.
Result<void> discardLearning(const std::string& folder);

/// Returns the text of best.json, which loadBehaviourParameters() reads.
std::string bestJson(const Learning& learning, const LearnedTeam& team, const std::string& program);
/// Returns curve.csv, with a line for each generation.
std::string curveCsv(const Learning& learning, const LearnedTeam& team);
std::string learnReportHtml(const Learning& learning, const LearnedTeam& team,
                            const std::string& program);

}  // namespace pitchboard::link
