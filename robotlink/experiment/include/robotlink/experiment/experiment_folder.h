// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The folder of an experiment's results. While it is played it holds experiment.json (the file with
// its scenario inside) and runs.jsonl, a line for each run that has ended; when all are there, also
// runs.csv, summary.json, report.md, report.html and junit.xml; of a tournament table.csv, too.
// Those files depend on the experiment only: not on the order of runs, threads, interruptions,
// shards, clock or folder. How fast runs with separate processes were played differs every time,
// and stands in times.csv. One thread at a time; a second program that opens the folder is refused.

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
  /// Makes the folder, or with `resume` goes on in it. Error Conflict when it holds results and is
  /// not resumed, or those of another experiment.
  static Result<ExperimentFolder> begin(const std::string& path, const Experiment& experiment,
                                        bool resume);

  const std::string& path() const { return m_path; }
  /// By number of run - 1.
  const std::vector<char>& finished() const { return m_finished; }
  std::size_t finishedCount() const { return m_count; }
  bool complete() const { return m_count == m_finished.size(); }
  /// Written and given to the system at once, so that a killed program loses nothing that is here.
  /// `timesRealTime`: how fast it was played, where that is to be kept.
  Result<void> add(const RunResult& result, std::optional<double> timesRealTime = {});
  /// Puts the lines in order; when all runs are there, writes the tables and reports.
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

/// The experiment whose results these are.
Result<Experiment> experimentOf(const std::string& folder);
/// All runs that are there. Paths only of those that are drawn.
Result<ResultTable> resultsOf(const std::string& folder, const Experiment& experiment);
/// Adds those of a folder to others of the same experiment, also while another program plays into
/// it. Nothing yet if there is no run; Conflict for another experiment's folder.
Result<void> addResults(ResultTable& table, const std::string& folder,
                        const Experiment& experiment);
/// One run; NotFound when it has not been played.
Result<RunResult> resultOf(const std::string& folder, const Experiment& experiment,
                           std::size_t number);
/// Marks a run of a folder as one that does not repeat, because it ended differently when it was
/// played again, and writes the tables and reports anew. Conflict while a program plays into it.
Result<void> markUnrepeatable(const std::string& folder, const Experiment& experiment,
                              std::size_t number);
/// Joins the folders of shards into a new one. Error Conflict for folders of different experiments,
/// and where one run has two results.
Result<ExperimentFolder> mergeFolders(const std::vector<std::string>& parts,
                                      const std::string& into, const Experiment& experiment);

}  // namespace pitchboard::link
