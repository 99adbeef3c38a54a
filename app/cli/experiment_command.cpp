// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <thread>

#include <app/scenario_options.h>
#include <base/duration_words.h>
#include <base/try.h>
#include <robotlink/experiment/experiment_folder.h>
#include <robotlink/experiment/run_player.h>
#include <robotlink/processes/team_program.h>

#include "commands.h"
#include "interrupt.h"
#include "progress.h"

namespace pitchboard::cli {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int exitAssertionFailed = 1;

/// A run of an experiment's results, played again into a session file. Error Conflict when it does
/// not end in the state that the results say, unless a team's own programs play in it.
Result<link::RunResult> recordRun(const std::string& folder, const link::Experiment& experiment,
                                  std::size_t number, const std::string& path,
                                  const link::PlaySettings& settings) {
  const auto before = link::resultOf(folder, experiment, number);
  if (!before) return before;
  std::error_code code;
  if (const auto parent = std::filesystem::path(path).parent_path(); !parent.empty()) {
    std::filesystem::create_directories(parent, code);
  }
  auto player = TRY(link::RunPlayer::create(experiment, settings));
  auto result = player.record(number, path, programName);
  if (!result) return result;
  if (result->hash != before->hash && !experiment.teamPrograms) {
    return failure(
        ErrorCode::Conflict,
        "run " + std::to_string(number) +
            " ended in a different state than in the results. Were they played by another version?",
        path);
  }
  return result;
}

struct ExperimentOptions {
  std::string experiment, out, shard, robotProgram;
  std::optional<std::uint64_t> seed;
  std::optional<std::size_t> runs;
  std::size_t jobs = 0;
  bool resume = false, list = false, progress = false;
};

struct Shard {
  std::size_t index = 1, count = 1;
};

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
                rate < 10.0 ? 2 : 0, rate, durationWords(left).c_str());
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
    TRY(recordRun(folder.path(), experiment, number, path, settings));
  }
  return {};
}

Result<int> told(const link::Experiment& experiment, const link::ExperimentFolder& folder) {
  const auto table = TRY(link::resultsOf(folder.path(), experiment));
  const link::ExperimentSummary summary = link::summarize(experiment, table);
  for (const link::ConditionSummary& condition : summary.conditions) {
    std::printf("%s: %zu runs", condition.name.c_str(), condition.runs);
    for (const auto& [end, count] : condition.ends) {
      std::printf(", %s %.1f %%", link::endWords(end).c_str(),
                  100.0 * static_cast<double>(count) / static_cast<double>(condition.runs));
    }
    std::printf("\n");
  }
  for (const link::CheckedAssertion& one : summary.assertions) {
    std::printf("%s  %s: %s (%s)\n", one.holds ? "holds " : "FAILED", one.condition.c_str(),
                one.text.c_str(), one.values.c_str());
  }
  std::printf("%s\n", (std::filesystem::path(folder.path()) / "report.html").c_str());
  return summary.holds() ? 0 : exitAssertionFailed;
}

Result<int> playExperiment(ExperimentOptions& options) {
  if (options.experiment.empty() || options.out.empty()) {
    return failure(ErrorCode::InvalidArgument,
                   "name an experiment and a folder for the results: pitchboard-cli experiment "
                   "paper-scenario-1 --out results");
  }
  const auto shard = TRY(shardFrom(options.shard));
  const auto experiment =
      TRY(link::loadExperiment(options.experiment, {options.seed, options.runs}));
  auto folder = TRY(link::ExperimentFolder::begin(options.out, experiment, options.resume));

  const InterruptGuard signals;
  link::PlaySettings settings;
  settings.robotProgram = options.robotProgram.empty() ? link::besideTeamProgram("pitchboard-robot")
                                                       : options.robotProgram;
  settings.cancelled = &interrupted;
  settings.folder = options.out;
  settings.program = programName;
  const std::vector<std::size_t> numbers = numbersOf(folder, shard);
  const std::size_t jobs =
      options.jobs > 0 ? options.jobs : std::max(1U, std::thread::hardware_concurrency());
  const auto begin = Clock::now();
  std::size_t done = 0;
  double busy = 0.0, simulated = 0.0;
  Result<void> played;
  {
    Progress progress(experiment.name, options.progress);
    played = link::playRuns(
        experiment, numbers, jobs, settings, [&](link::PlayedRun one) -> Result<void> {
          ++done;
          busy += one.wallSeconds;
          simulated += one.simulatedSeconds;
          const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
          progress.say(progressText(done, numbers.size(), seconds));
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
                   options.out);
  }
  TRY(recordRuns(experiment, folder, shard, settings));
  if (!folder.complete()) {
    std::printf("%zu of %zu runs are in %s; \"experiment merge\" joins the shards\n",
                folder.finishedCount(), experiment.allRuns(), options.out.c_str());
    return 0;
  }
  return told(experiment, folder);
}

void addMerge(CLI::App& parent, int& exitCode) {
  struct Merge {
    std::vector<std::string> parts;
    std::string out;
  };
  auto options = std::make_shared<Merge>();
  CLI::App* command =
      parent.add_subcommand("merge",
                            "Merge the results of shards into the files of a single run.\n"
                            "Example: pitchboard-cli experiment merge part1 part2 --out all");
  command->add_option("parts", options->parts, "Folders of the shards")
      ->required()
      ->type_name("DIR...");
  command->add_option("--out", options->out, "A new folder")->required()->type_name("DIR");
  whenChosen(*command, options, exitCode, [](Merge& chosen) -> Result<int> {
    const auto experiment = TRY(link::experimentOf(chosen.parts.front()));
    const auto merged = TRY(link::mergeFolders(chosen.parts, chosen.out, experiment));
    if (merged.complete()) return told(experiment, merged);
    return failure(ErrorCode::NotFound,
                   std::to_string(merged.finishedCount()) + " of " +
                       std::to_string(experiment.allRuns()) + " runs found; a shard is missing",
                   chosen.out);
  });
}

void addReplay(CLI::App& parent, int& exitCode) {
  struct Replay {
    std::string folder, output, robotProgram;
    std::size_t run = 1;
    bool open = false;
  };
  auto options = std::make_shared<Replay>();
  CLI::App* command = parent.add_subcommand(
      "replay",
      "Play a run again and record it. Exits with 1 if it ends in another state.\n"
      "Example: pitchboard-cli experiment replay results --run 417 --open");
  command->add_option("folder", options->folder, "The results")->required()->type_name("DIR");
  command->add_option("--run", options->run, "Its number in runs.csv")->required()->type_name("N");
  command
      ->add_option("-o,--output", options->output,
                   "A new session; default: sessions/run-N.mcap in the folder")
      ->type_name("FILE.mcap");
  command->add_flag("--open", options->open, "Open it in the studio");
  command
      ->add_option("--robot-program", options->robotProgram,
                   "Program of separate processes; default: pitchboard-robot beside this one")
      ->type_name("FILE");
  whenChosen(*command, options, exitCode, [](Replay& chosen) -> Result<int> {
    const auto experiment = TRY(link::experimentOf(chosen.folder));
    const InterruptGuard signals;
    link::PlaySettings settings;
    settings.cancelled = &interrupted;
    settings.robotProgram = chosen.robotProgram.empty()
                                ? link::besideTeamProgram("pitchboard-robot")
                                : chosen.robotProgram;
    const std::string path =
        chosen.output.empty() ? link::sessionPath(chosen.folder, chosen.run) : chosen.output;
    if (!std::filesystem::exists(path) || !chosen.output.empty()) {
      const auto result = TRY(recordRun(chosen.folder, experiment, chosen.run, path, settings));
      std::printf("%s: run %zu, seed %" PRIu64 ", %s, state hash 0x%016" PRIx64 ", %s\n",
                  path.c_str(), result.number, result.seed, link::endWords(result.endedBy).c_str(),
                  result.hash,
                  experiment.teamPrograms ? "played again: team programs do not repeat exactly"
                                          : "as in the results");
    } else {
      std::printf("%s: already there\n", path.c_str());
    }
    if (!chosen.open) return 0;
    const std::string studio = link::besideTeamProgram("pitchboard");
    std::fflush(stdout);
    ::execlp(studio.c_str(), studio.c_str(), path.c_str(), static_cast<char*>(nullptr));
    return failure(ErrorCode::SystemError, "the studio cannot be started", studio);
  });
}

}  // namespace

void addExperimentCommand(CLI::App& parent, int& exitCode) {
  auto options = std::make_shared<ExperimentOptions>();
  ExperimentOptions& o = *options;
  CLI::App* command = parent.add_subcommand(
      "experiment",
      "Play an experiment: many runs under several conditions, with tables and a report. Exits "
      "with 1 if an assertion fails.\n"
      "Examples: pitchboard-cli experiment paper-scenario-1 --out results --jobs 2\n"
      "          pitchboard-cli experiment mine.json --out part2 --shard 2/8");
  command->add_option("experiment", o.experiment, "Built-in name or a JSON file")
      ->type_name("NAME|FILE");
  command->add_option("--out", o.out, "The folder for the results")->type_name("DIR");
  command->add_option("--jobs", o.jobs, "Runs at a time; default: one for each processor")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  command->add_option("--seed", o.seed, "Of the first run; default: the experiment's")
      ->check(shared::refuseNegative)
      ->type_name("N");
  command->add_option("--runs", o.runs, "Of each condition; default: the experiment's")
      ->type_name("N")
      ->check(CLI::Range(1, 1'000'000));
  command->add_option("--shard", o.shard, "Run shard i of n")->type_name("i/n");
  command->add_flag("--resume", o.resume, "Continue with the results in the folder");
  command->add_flag("--list", o.list, "List the built-in experiments");
  command->add_flag("--progress", o.progress,
                    "Print progress to stderr even if it is not a terminal");
  command
      ->add_option("--robot-program", o.robotProgram,
                   "Program of separate processes; default: pitchboard-robot beside this one")
      ->type_name("FILE");
  command->require_subcommand(0, 1);
  addMerge(*command, exitCode);
  addReplay(*command, exitCode);
  command->callback([command, options, &exitCode] {
    if (!command->get_subcommands().empty()) return;
    if (options->list) {
      for (const link::ExperimentName& one : link::builtInExperiments()) {
        std::printf("%-24s %s\n", one.name.c_str(), one.title.c_str());
      }
      return;
    }
    exitCode = exitCodeOf(playExperiment(*options));
  });
}

}  // namespace pitchboard::cli
