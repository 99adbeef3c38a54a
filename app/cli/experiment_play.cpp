// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment_play.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <thread>

#include <base/duration_text.h>
#include <base/try.h>
#include <robotlink/processes/team_program.h>

#include "interrupt.h"
#include "progress.h"

namespace pitchboard::cli {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int exitAssertionFailed = 1;

/// Runs that are this shard's and have not been played.
std::vector<std::size_t> numbersOf(const link::ExperimentFolder& folder, const Shard& shard) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < folder.finished().size(); ++i) {
    if (i % shard.count == shard.index - 1 && !folder.finished()[i]) numbers.push_back(i + 1);
  }
  return numbers;
}

/// "417 of 2000 runs, 118 runs/s, 13 s left".
std::string progressText(std::size_t done, std::size_t all, double seconds) {
  const double rate = seconds > 0.0 ? static_cast<double>(done) / seconds : 0.0;
  const double left = rate > 0.0 ? static_cast<double>(all - done) / rate + 0.5 : 0.0;
  char text[96];
  std::snprintf(text, sizeof text, "%zu of %zu runs, %.*f runs/s, %s left", done, all,
                rate < 10.0 ? 2 : 0, rate, durationText(left).c_str());
  return text;
}

/// Sessions of the runs that the experiment wants recorded, and that are not there yet.
Result<void> recordRuns(const link::Experiment& experiment, const link::ExperimentFolder& folder,
                        const Shard& shard, const link::PlaySettings& settings) {
  if (experiment.record == link::Record::Nothing) return {};
  const auto table = TRY(link::resultsOf(folder.path(), experiment));
  for (std::size_t number = 1; number <= experiment.allRuns() && !interrupted; ++number) {
    if ((number - 1) % shard.count != shard.index - 1) continue;
    const link::RunPlace place = link::placeOf(experiment, number);
    const bool success = table.conditions[place.condition].columns[0][place.index] != 0.0;
    if (!link::isRecorded(experiment, number, success)) continue;
    const std::string path = link::sessionPath(folder.path(), number);
    if (std::filesystem::exists(path)) continue;
    TRY(link::recordAgain(folder.path(), experiment, number, path, settings));
  }
  return {};
}

void printTable(const link::TournamentTable& table) {
  std::size_t width = 4;
  for (const auto& team : table.teams) width = std::max(width, team.name.size());
  std::printf("%s  Played  Won  Drawn  Lost  Goals      Difference, 95 %%          Points\n",
              padded("Team", width).c_str());
  for (const auto& [name, totals] : table.teams) {
    char goals[32], range[64] = "";
    std::snprintf(goals, sizeof goals, "%d : %d", totals.goals, totals.goalsAgainst);
    if (totals.difference95) {
      std::snprintf(range, sizeof range, " [%+.2f, %+.2f]", totals.difference95->low,
                    totals.difference95->high);
    }
    std::printf("%s  %6zu  %3zu  %5zu  %4zu  %-9s  %+.2f%-18s  %6zu\n", padded(name, width).c_str(),
                totals.played(), totals.won, totals.drawn, totals.lost, goals, totals.difference,
                range, totals.points());
  }
  for (const auto& [name, totals] : table.teams) {
    if (totals.wonByCoin == 0) continue;
    std::printf("%s won %zu by coin, after a shoot-out\n", name.c_str(), totals.wonByCoin);
  }
  for (const auto& [number, what] : table.wrong)
    std::printf("WRONG   run %zu: %s\n", number, what.c_str());
}

void printConditions(const link::ExperimentSummary& summary) {
  for (const link::ConditionSummary& condition : summary.conditions) {
    std::printf("%s: %zu runs", condition.name.c_str(), condition.runs);
    for (const auto& [end, count] : condition.ends) {
      std::printf(", %s %.1f %%", link::endText(end).c_str(),
                  100.0 * static_cast<double>(count) / static_cast<double>(condition.runs));
    }
    std::printf("\n");
  }
}

}  // namespace

void addPlayInto(CLI::App& command, PlayInto& o) {
  command.add_option("--out", o.folder, "Folder for the results")->type_name("DIR");
  command
      .add_option("--jobs", o.jobs,
                  "Runs at the same time; default: one per processor (per two processors with team "
                  "programs)")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  command.add_option("--shard", o.shard, "Run only shard i of n")->type_name("i/n");
  CLI::Option* resume =
      command.add_flag("--resume", o.resume, "Continue with the results in the folder");
  addForce(command, o.force, "Discard the results in the folder and start over");
  resume->excludes(command.get_option("--force"));
  command.add_flag("--progress", o.progress,
                   "Print progress to stderr even if it is not a terminal");
  command
      .add_option("--robot-program", o.robotProgram,
                  "Program of separate processes; default: pitchboard-robot beside this program")
      ->type_name("FILE");
}

Result<Shard> shardFrom(const std::string& text) {
  if (text.empty()) return Shard{};
  const std::size_t slash = text.find('/');
  const auto index = shared::numberFrom(text.substr(0, slash));
  const auto count =
      slash == std::string::npos ? std::nullopt : shared::numberFrom(text.substr(slash + 1));
  if (!index || !count || *index < 1 || *count < 1 || *index > *count || *count > 1e6 ||
      *index != static_cast<double>(static_cast<std::size_t>(*index)) ||
      *count != static_cast<double>(static_cast<std::size_t>(*count))) {
    return failure(ErrorCode::InvalidArgument, "--shard must be i/n, such as 2/8: the second of 8");
  }
  return Shard{static_cast<std::size_t>(*index), static_cast<std::size_t>(*count)};
}

std::size_t jobsFor(const PlayInto& options, bool teamPrograms) {
  const std::size_t processors = std::max(1U, std::thread::hardware_concurrency());
  if (options.jobs > 0) return options.jobs;
  return teamPrograms ? std::max<std::size_t>(1, processors / 2) : processors;
}

std::string robotProgram(const std::string& chosen) {
  return chosen.empty() ? link::besideTeamProgram("pitchboard-robot") : chosen;
}

Result<int> playInto(const link::Experiment& experiment, const PlayInto& options) {
  const auto shard = TRY(shardFrom(options.shard));
  if (options.force) TRY(link::discardResults(options.folder));
  auto folder = TRY(link::ExperimentFolder::begin(options.folder, experiment, options.resume));

  const InterruptGuard signals;
  link::PlaySettings settings;
  settings.robotProgram = robotProgram(options.robotProgram);
  settings.cancelled = &interrupted;
  settings.folder = options.folder;
  settings.program = programName;
  const std::vector<std::size_t> numbers = numbersOf(folder, shard);
  const std::size_t jobs = jobsFor(options, experiment.hasTeamPrograms());
  const auto begin = Clock::now();
  std::size_t done = 0;
  double busy = 0.0, simulated = 0.0;
  Result<void> played;
  {
    Progress progress(experiment.name, options.progress);
    played = link::playRuns(
        experiment, numbers, jobs, settings, [&](const link::PlayedRun& one) -> Result<void> {
          ++done;
          busy += one.wallSeconds;
          simulated += one.simulatedSeconds;
          const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
          progress.show(progressText(done, numbers.size(), seconds));
          return folder.add(one.result, one.timesRealTime);
        });
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  const auto finished = folder.finish();
  TRY(played);
  TRY(finished);
  if (done > 0) {
    std::fprintf(stderr,
                 "%zu runs in %.1f s, %.1f runs/s; a run was played %.1f times as fast as real "
                 "time\n",
                 done, seconds, static_cast<double>(done) / std::max(seconds, 1e-9),
                 simulated / std::max(busy, 1e-9));
  }
  if (interrupted) {
    return failure(ErrorCode::Conflict,
                   "interrupted after " + std::to_string(folder.finishedCount()) + " of " +
                       std::to_string(experiment.allRuns()) + " runs; add --resume to continue",
                   options.folder);
  }
  TRY(recordRuns(experiment, folder, shard, settings));
  if (folder.complete()) return printResults(experiment, folder);
  std::printf("%zu of %zu runs are in %s; \"experiment merge\" joins the shards\n",
              folder.finishedCount(), experiment.allRuns(), options.folder.c_str());
  return 0;
}

int printSummary(const link::Experiment& experiment, const link::ExperimentSummary& summary) {
  if (summary.tournament) {
    printTable(*summary.tournament);
  } else {
    printConditions(summary);
  }
  std::size_t unrepeatable = 0;
  for (const link::ConditionSummary& condition : summary.conditions) {
    unrepeatable += condition.unrepeatable;
  }
  if (unrepeatable > 0) {
    std::printf("%zu of %zu runs are not repeatable\n", unrepeatable, experiment.allRuns());
  }
  for (const std::string& text : link::identicalTexts(summary)) std::printf("%s\n", text.c_str());
  for (const link::CheckedAssertion& one : summary.assertions) {
    std::printf("%s  %s: %s (%s)\n", one.holds ? "holds " : "FAILED", one.condition.c_str(),
                one.text.c_str(), one.values.c_str());
  }
  return summary.holds() ? 0 : exitAssertionFailed;
}

Result<int> printResults(const link::Experiment& experiment, const link::ExperimentFolder& folder) {
  const auto table = TRY(link::resultsOf(folder.path(), experiment));
  const int ended = printSummary(experiment, link::summarize(experiment, table));
  std::printf("%s\n", (std::filesystem::path(folder.path()) / "report.html").c_str());
  return ended;
}

}  // namespace pitchboard::cli
