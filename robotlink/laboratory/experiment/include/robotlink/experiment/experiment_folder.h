// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The folder with the results of an experiment. During the experiment it contains experiment.json
// (the file with its scenario included) and runs.jsonl with a line for each run that has ended.
// After the last run it also contains runs.csv, summary.json, report.md, report.html and junit.xml,
// and table.csv for a tournament. These files depend only on the experiment: not on the order of
// runs, threads, interruptions, shards, clock or folder. The speed of runs with separate processes
// differs every time and is kept in times.csv. One thread at a time; a second program that opens
// the folder gets an error.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <base/unique_fd.h>
#include <robotlink/experiment/experiment_summary.h>

namespace pitchboard::link {

inline constexpr const char* experimentFile = "experiment.json";
inline constexpr const char* runsFile = "runs.jsonl";
inline constexpr const char* timesFile = "times.csv";
inline constexpr const char* sessionsFolder = "sessions";

class ExperimentFolder {
 public:
  /// Creates the folder, or with `resume` continues in it. Error Conflict if it contains results of
  /// another experiment, or any results without `resume`.
  static Result<ExperimentFolder> begin(const std::string& path, const Experiment& experiment,
                                        bool resume);

  const std::string& path() const { return m_path; }
  /// Returns 1 for each run that has a result, indexed by number - 1.
  const std::vector<char>& finished() const { return m_finished; }
  std::size_t finishedCount() const { return m_count; }
  bool complete() const { return m_count == m_finished.size(); }
  /// Writes a result immediately, so that it is kept even if the program is killed afterwards.
  /// `timesRealTime` is the speed of the run, for times.csv.
  Result<void> add(const RunResult& result, std::optional<double> timesRealTime = {});
  /// Sorts the lines, and writes tables and reports if all runs have ended.
  Result<void> finish();

 private:
  friend Result<void> markUnrepeatable(const std::string& folder, const Experiment& experiment,
                                       std::size_t number);
  friend Result<ExperimentFolder> mergeFolders(const std::vector<std::string>& parts,
                                               const std::string& into,
                                               const Experiment& experiment);
  ExperimentFolder(std::string path, const Experiment& experiment);
  std::string file(const char* name) const;
  tl::unexpected<Error> failed() const;
  Result<void> putTimes(std::string_view rows);
  Result<void> addTimesOf(const std::string& part);
  Result<void> sortLines();
  Result<void> writeReports() const;

  std::string m_path;
  const Experiment* m_experiment;
  std::vector<char> m_finished;
  std::size_t m_count = 0;
  UniqueFd m_lines, m_times;
};

/// Removes the results of an experiment, its reports and its sessions from their folder, and
/// nothing else that is there. Does nothing if there are none. Error Conflict while another program
/// plays it.
Result<void> discardResults(const std::string& folder);

/// Reads the experiment of a results folder.
Result<Experiment> experimentOf(const std::string& folder);
/// Reads all results; paths only of those runs that the report draws.
Result<ResultTable> resultsOf(const std::string& folder, const Experiment& experiment);
/// Adds the results of a folder to those of the same experiment, also while another program plays
/// into it. Adds nothing if the folder has no results yet. Error Conflict for the folder of another
/// experiment.
Result<void> addResults(ResultTable& table, const std::string& folder,
                        const Experiment& experiment);
/// Reads the result of a run. Error NotFound if it has not been played.
Result<RunResult> resultOf(const std::string& folder, const Experiment& experiment,
                           std::size_t number);
/// Marks a run as not repeatable, because it ended differently when it was played again, and
/// rewrites tables and reports. Error Conflict while another program uses the folder.
Result<void> markUnrepeatable(const std::string& folder, const Experiment& experiment,
                              std::size_t number);
/// Joins the folders of shards into a new one. Error Conflict if they belong to different
/// experiments, or if a run has two results.
Result<ExperimentFolder> mergeFolders(const std::vector<std::string>& parts,
                                      const std::string& into, const Experiment& experiment);

}  // namespace pitchboard::link
