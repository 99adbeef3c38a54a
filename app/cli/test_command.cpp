// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <thread>

#include <base/file_target.h>
#include <robotlink/experiment/experiment_summary.h>
#include <robotlink/experiment/junit_report.h>
#include <robotlink/experiment/run_player.h>
#include <robotlink/processes/own_program.h>

#include "commands.h"
#include "interrupt.h"

namespace pitchboard::cli {
namespace {

struct Options {
  std::string folder, junit, robotProgram;
  std::size_t jobs = 0;
  bool list = false;
};

/// Every *.json of the folder and the folders in it, in order of name; the shipped ones without a
/// folder.
Result<std::vector<std::string>> testsIn(const std::string& folder) {
  std::vector<std::string> out;
  if (folder.empty()) {
    for (const link::ExperimentName& one : link::builtInSituations()) out.push_back(one.name);
    return out;
  }
  std::error_code code;
  if (std::filesystem::is_regular_file(folder, code)) return std::vector<std::string>{folder};
  std::filesystem::recursive_directory_iterator files(folder, code);
  if (code) return failure(ErrorCode::NotFound, "cannot be read: " + code.message(), folder);
  for (const auto& entry : files) {
    if (entry.is_regular_file() && entry.path().extension() == ".json") {
      out.push_back(entry.path().string());
    }
  }
  std::sort(out.begin(), out.end());
  if (out.empty()) return failure(ErrorCode::NotFound, "there is no .json file in it", folder);
  return out;
}

Result<link::ExperimentSummary> played(const link::Experiment& experiment, const Options& options) {
  link::PlaySettings settings;
  settings.cancelled = &interrupted;
  settings.robotProgram = options.robotProgram.empty() ? link::besideOwnProgram("pitchboard-robot")
                                                       : options.robotProgram;
  std::vector<std::size_t> numbers(experiment.allRuns());
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = i + 1;
  const std::size_t jobs =
      options.jobs > 0 ? options.jobs : std::max(1U, std::thread::hardware_concurrency());
  link::ResultTable table(experiment);
  const auto done = link::playRuns(experiment, numbers, jobs, settings,
                                   [&](const link::PlayedRun& one) -> Result<void> {
                                     table.add(experiment, one.result);
                                     return {};
                                   });
  if (!done) return tl::unexpected(done.error());
  if (interrupted) return failure(ErrorCode::Conflict, "interrupted");
  return link::summarize(experiment, table);
}

int run(const Options& options) {
  const auto tests = testsIn(options.folder);
  if (!tests) return reportError(tests.error());
  const InterruptGuard signals;
  std::vector<link::TestedExperiment> tested;
  std::size_t assertions = 0, failures = 0;
  for (const std::string& name : *tests) {
    auto experiment = link::loadExperiment(name);
    if (!experiment) return reportError(experiment.error());
    if (experiment->assertions.empty()) {
      return reportError(
          {ErrorCode::InvalidArgument, "has no assertions, so it tests nothing", name});
    }
    auto summary = played(*experiment, options);
    if (!summary) return reportError(summary.error());
    for (const link::CheckedAssertion& one : summary->assertions) {
      ++assertions;
      failures += !one.holds;
      std::printf("%s  %s, %s: %s (%s)\n", one.holds ? "holds " : "FAILED",
                  experiment->name.c_str(), one.condition.c_str(), one.text.c_str(),
                  one.values.c_str());
      std::fflush(stdout);
    }
    tested.push_back({std::move(*experiment), std::move(*summary)});
  }
  std::printf("%zu tests, %zu assertions, %zu failed\n", tests->size(), assertions, failures);
  if (!options.junit.empty()) {
    const auto wrote = writeFile(options.junit, link::junitReport(tested), IfExists::Replace);
    if (!wrote) return reportError(wrote.error());
  }
  return failures == 0 ? 0 : 1;
}

}  // namespace

void addTestCommand(CLI::App& parent, int& exitCode) {
  auto options = std::make_shared<Options>();
  Options& o = *options;
  CLI::App* command = parent.add_subcommand(
      "test",
      "Plays situations with assertions (experiment files) and says which hold. Exit 1 when one "
      "does not\n"
      "Example: pitchboard-cli test situations --junit results.xml");
  command
      ->add_option("folder", o.folder,
                   "A folder of experiment files, or one file; default: the examples that are part "
                   "of the program")
      ->type_name("DIR|FILE");
  command->add_option("--junit", o.junit, "Write the outcome as JUnit XML")->type_name("FILE.xml");
  command->add_option("--jobs", o.jobs, "Runs at a time; default: one for each processor")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--list", o.list, "Print the examples");
  command
      ->add_option("--robot-program", o.robotProgram,
                   "Program of separate processes; default: pitchboard-robot beside this one")
      ->type_name("FILE");
  command->callback([options, &exitCode] {
    if (options->list) {
      for (const link::ExperimentName& one : link::builtInSituations()) {
        std::printf("%-24s %s\n", one.name.c_str(), one.title.c_str());
      }
      return;
    }
    exitCode = run(*options);
  });
}

}  // namespace pitchboard::cli
