// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plays runs of an experiment: RunPlayer one after another in its thread, playRuns() many in
// threads of its own. A run depends on its number only, so that order, threads and computers make
// no difference to its result.

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include <base/result.h>
#include <robotlink/experiment/run_result.h>

namespace pitchboard::link {

class Check;
class MatchPlayer;
class TeamPrograms;
class RunMeasure;

struct PlaySettings {
  std::string robotProgram;  ///< pitchboard-robot, for separate processes
  /// Where playRuns() puts sessions of runs that cannot be played again because a team's own
  /// programs play in them: the results folder, and the name and version for the files, also of
  /// recordAgain().
  std::string folder{}, program{};
  /// Set by anybody: runs that are being played end without a result.
  const std::atomic<bool>* cancelled = nullptr;
};

/// The session of a run: "results/sessions/run-000417.mcap".
std::string sessionPath(const std::string& folder, std::size_t number);

/// One thread. `experiment` must outlive it.
class RunPlayer {
 public:
  static Result<RunPlayer> create(const Experiment& experiment, PlaySettings settings);
  RunPlayer(RunPlayer&&) noexcept;
  ~RunPlayer();

  /// Error Conflict with the message "cancelled" when it was.
  Result<RunResult> play(std::size_t number);
  /// The same, recorded into a new session file. `program`: name and version, for the file.
  Result<RunResult> record(std::size_t number, const std::string& path, const std::string& program);
  /// s that the last run took, and s that were simulated in it.
  double wallSeconds() const { return m_wall; }
  double simulatedSeconds() const { return m_simulated; }
  /// How many times as fast as real time the last run was played, once its programs were there;
  /// nothing unless they are separate processes or a team's own.
  std::optional<double> timesRealTime() const { return m_timesRealTime; }

 private:
  RunPlayer(const Experiment& experiment, PlaySettings settings, std::unique_ptr<Check> success);
  struct Recording;
  Result<RunResult> playOne(std::size_t number, const Recording* recording);
  Result<void> loop(MatchPlayer& player, const RunMeasure& measure, std::size_t condition,
                    TeamPrograms* own);

  const Experiment* m_experiment;
  PlaySettings m_settings;
  std::unique_ptr<Check> m_success;
  double m_wall = 0.0, m_simulated = 0.0;
  std::optional<double> m_timesRealTime;
};

/// A run of a results folder, played again into a session file. Error Conflict if a run that the
/// results call repeatable ends in another state: they say so from then on.
Result<RunResult> recordAgain(const std::string& folder, const Experiment& experiment,
                              std::size_t number, const std::string& path,
                              const PlaySettings& settings);

struct PlayedRun {
  RunResult result;
  double wallSeconds = 0.0, simulatedSeconds = 0.0;
  std::optional<double> timesRealTime;  ///< as of RunPlayer
};

/// Plays the runs of these numbers in `jobs` threads. `take` is called in one of them at a time, in
/// the order in which they end. The first error ends everything; `cancelled` ends it without one.
Result<void> playRuns(const Experiment& experiment, std::span<const std::size_t> numbers,
                      std::size_t jobs, const PlaySettings& settings,
                      const std::function<Result<void>(PlayedRun)>& take);

}  // namespace pitchboard::link
