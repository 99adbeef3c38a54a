// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>
#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <memory>

#include <app/option_arguments.h>
#include <app/scenario_options.h>
#include <base/try.h>
#include <robotlink/processes/team_program.h>

#include "commands.h"
#include "experiment_play.h"
#include "interrupt.h"

namespace pitchboard::cli {
namespace {

struct ExperimentOptions {
  std::string experiment;
  PlayInto play;
  std::optional<std::uint64_t> seed;
  std::optional<std::size_t> runs;
  bool list = false;
};

Result<int> playExperiment(const ExperimentOptions& options) {
  if (options.experiment.empty() || options.play.folder.empty()) {
    return failure(ErrorCode::InvalidArgument,
                   "name an experiment and a folder for the results: pitchboard-cli experiment "
                   "paper-scenario-1 --out results");
  }
  const auto experiment =
      TRY(link::loadExperiment(options.experiment, {options.seed, options.runs}));
  return playInto(experiment, options.play);
}

void addMerge(CLI::App& parent, int& exitCode) {
  struct Merge {
    std::vector<std::string> parts;
    std::string out;
    bool force = false;
  };
  auto options = std::make_shared<Merge>();
  CLI::App* command =
      parent.add_subcommand("merge",
                            "Merge the results of shards into the files of one experiment.\n"
                            "Example: pitchboard-cli experiment merge part1 part2 --out all");
  command->add_option("parts", options->parts, "Folders of the shards")
      ->required()
      ->type_name("DIR");
  command->add_option("--out", options->out, "New folder for the results")
      ->required()
      ->type_name("DIR");
  addForce(*command, options->force, "Discard the results in the new folder first");
  whenChosen(*command, options, exitCode, [](Merge& chosen) -> Result<int> {
    const auto experiment = TRY(link::experimentOf(chosen.parts.front()));
    if (chosen.force) {
      for (const std::string& part : chosen.parts) {
        if (!isSameFile(part, chosen.out)) continue;
        return failure(ErrorCode::Conflict, "this folder is one of the parts; choose another",
                       chosen.out);
      }
      TRY(link::discardResults(chosen.out));
    }
    const auto merged = TRY(link::mergeFolders(chosen.parts, chosen.out, experiment));
    if (merged.complete()) return printResults(experiment, merged);
    return failure(ErrorCode::NotFound,
                   std::to_string(merged.finishedCount()) + " of " +
                       std::to_string(experiment.allRuns()) + " runs found; a shard is missing",
                   chosen.out);
  });
}

void addReport(CLI::App& parent, int& exitCode) {
  auto folder = std::make_shared<std::string>();
  CLI::App* command =
      parent.add_subcommand("report",
                            "Write tables and report of finished results again, and print them. "
                            "Exits with 1 if an assertion fails.\n"
                            "Example: pitchboard-cli experiment report results");
  command->add_option("folder", *folder, "Folder of results")->required()->type_name("DIR");
  whenChosen(*command, folder, exitCode, [](const std::string& chosen) -> Result<int> {
    const auto experiment = TRY(link::experimentOf(chosen));
    auto results = TRY(link::ExperimentFolder::begin(chosen, experiment, true));
    if (!results.complete()) {
      return failure(ErrorCode::NotFound,
                     std::to_string(results.finishedCount()) + " of " +
                         std::to_string(experiment.allRuns()) +
                         " runs have ended; play the others with pitchboard-cli experiment "
                         "EXPERIMENT --out " +
                         chosen + " --resume",
                     chosen);
    }
    TRY(results.finish());
    return printResults(experiment, results);
  });
}

void addReplay(CLI::App& parent, int& exitCode) {
  struct Replay {
    std::string folder, output, robotProgram;
    std::size_t run = 1;
    bool open = false, force = false;
  };
  auto options = std::make_shared<Replay>();
  CLI::App* command = parent.add_subcommand(
      "replay",
      "Play a run again and record it. Exits with 1 if it ends in another state.\n"
      "Example: pitchboard-cli experiment replay results --run 417 --open");
  command->add_option("folder", options->folder, "Folder of results")->required()->type_name("DIR");
  command->add_option("--run", options->run, "Number of the run in runs.csv")
      ->required()
      ->type_name("N");
  command
      ->add_option("-o,--output", options->output,
                   "New recording; default: sessions/run-N.mcap in the folder")
      ->type_name("FILE.mcap");
  addForce(*command, options->force, "Replace an existing recording");
  command->add_flag("--open", options->open, "Open it in the studio");
  command
      ->add_option("--robot-program", options->robotProgram,
                   "Program of separate processes; default: pitchboard-robot beside this program")
      ->type_name("FILE");
  whenChosen(*command, options, exitCode, [](Replay& chosen) -> Result<int> {
    const auto experiment = TRY(link::experimentOf(chosen.folder));
    const InterruptGuard signals;
    link::PlaySettings settings;
    settings.cancelled = &interrupted;
    settings.robotProgram = robotProgram(chosen.robotProgram);
    settings.program = programName;
    const std::string path =
        chosen.output.empty() ? link::sessionPath(chosen.folder, chosen.run) : chosen.output;
    const auto before = TRY(link::resultOf(chosen.folder, experiment, chosen.run));
    const char* doubt = before.match.repeatable ? "" : "; the run is not repeatable";
    if (!chosen.output.empty()) TRY(ifExists(path, chosen.force));
    if (!std::filesystem::exists(path) || !chosen.output.empty() || chosen.force) {
      settings.replace = chosen.force;
      const auto result =
          TRY(link::recordAgain(chosen.folder, experiment, chosen.run, path, settings));
      std::printf(
          "%s: run %zu, seed %" PRIu64 ", %s, state hash 0x%016" PRIx64 ", %s%s\n", path.c_str(),
          result.number, result.seed, link::endText(result.match.endedBy).c_str(), result.hash,
          result.hash == before.hash ? "as in the results" : "which is not that of the results",
          doubt);
    } else {
      std::printf("%s: already there%s\n", path.c_str(), doubt);
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
  addPlayInto(*command, o.play);
  command->add_option("--seed", o.seed, "Seed of the first run; default: the experiment's")
      ->check(shared::refuseNegative)
      ->type_name("N");
  command->add_option("--runs", o.runs, "Runs of each condition; default: the experiment's")
      ->type_name("N")
      ->check(CLI::Range(1, 1'000'000));
  command->add_flag("--list", o.list, "Print the built-in experiments");
  command->require_subcommand(0, 1);
  addMerge(*command, exitCode);
  addReplay(*command, exitCode);
  addReport(*command, exitCode);
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
