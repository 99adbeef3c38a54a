// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plays the runs of an experiment: RunPlayer one after another on the calling thread, playRuns()
// many at once on its own threads. The result of a run depends only on the experiment and its
// number, not on order, threads or computer.

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
  /// Results folder, in which playRuns() records runs with team programs, because they cannot be
  /// repeated.
  std::string folder{};
  std::string program{};  ///< name and version to write to session files
  bool replace = false;   ///< existing sessions
  /// Once true, runs that are being played end without a result. Any thread may set it.
  const std::atomic<bool>* cancelled = nullptr;
};

/// Returns the path of a run's session, such as "results/sessions/run-000417.mcap".
std::string sessionPath(const std::string& folder, std::size_t number);

/// Used on one thread. `experiment` must outlive it.
class RunPlayer {
 public:
  static Result<RunPlayer> create(const Experiment& experiment, PlaySettings settings);
  RunPlayer(RunPlayer&&) noexcept;
  ~RunPlayer();

  /// Plays a run. If cancelled, returns error Conflict with the message "cancelled".
  Result<RunResult> play(std::size_t number);
  /// Plays a run and records it in a new session file. `program` is a name and version for the
  /// file.
  Result<RunResult> record(std::size_t number, const std::string& path, const std::string& program);
  // Duration of the last run, in real and in simulated seconds.
  double wallSeconds() const { return m_wall; }
  double simulatedSeconds() const { return m_simulated; }
  /// Returns the speed of the last run, times real time, without the time for starting programs.
  /// Empty unless the run used separate processes or team programs.
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

/// Plays a run of a results folder again and records it. If a run that is marked as repeatable ends
/// in another state, marks it as not repeatable and returns error Conflict.
Result<RunResult> recordAgain(const std::string& folder, const Experiment& experiment,
                              std::size_t number, const std::string& path,
                              const PlaySettings& settings);

/// Returns whether a run that was recorded in this file gives the same result when it is played
/// again, as its results folder says. Empty for a file that is not a run's session.
std::optional<bool> isRunRepeatable(const std::string& session);

struct PlayedRun {
  RunResult result;
  double wallSeconds = 0.0, simulatedSeconds = 0.0;
  std::optional<double> timesRealTime;  ///< see RunPlayer
};

/// Plays the runs with these numbers on `jobs` threads. `take` gets each result in the order in
/// which runs end, on any of the threads but never on two at a time. The first error ends
/// everything and is returned; cancelling ends everything without an error.
Result<void> playRuns(const Experiment& experiment, std::span<const std::size_t> numbers,
                      std::size_t jobs, const PlaySettings& settings,
                      const std::function<Result<void>(PlayedRun)>& take);

}  // namespace pitchboard::link
