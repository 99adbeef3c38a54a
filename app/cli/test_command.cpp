// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <thread>

#include <base/file_target.h>
#include <base/try.h>
#include <robotlink/experiment/experiment_summary.h>
#include <robotlink/experiment/junit_report.h>
#include <robotlink/experiment/run_player.h>
#include <robotlink/processes/team_program.h>

#include "commands.h"
#include "interrupt.h"

namespace pitchboard::cli {
namespace {

struct TestOptions {
  std::string folder, junit, robotProgram;
  std::size_t jobs = 0;
  bool list = false;
};

/// A file to play, or a folder that cannot be read.
struct Found {
  std::string path;
  std::optional<Error> error;
};

/// Adds every *.json in `folder` and below it, but the rules that tests name; links to folders are
/// followed once.
void collect(const std::filesystem::path& folder, std::set<std::filesystem::path>& seen,
             std::vector<Found>& out) {
  std::error_code code;
  const auto place = std::filesystem::canonical(folder, code);
  if (!code && !seen.insert(place).second) return;
  std::filesystem::directory_iterator files(folder, code);
  for (; !code && files != std::filesystem::directory_iterator(); files.increment(code)) {
    std::error_code unknown;  // a link to nothing is no folder, and reading it says why
    if (files->is_directory(unknown)) {
      collect(files->path(), seen, out);
    } else if (files->path().extension() == ".json" &&
               !telemetry::rulesFromFile(files->path().string())) {
      out.push_back({files->path().string(), {}});
    }
  }
  if (!code) return;
  out.push_back({folder.string(),
                 Error{ErrorCode::NotFound, "cannot be read: " + code.message(), folder.string()}});
}

/// The tests of a folder in order of their paths, one file, or an example that is part of the
/// program; all examples if `name` is empty.
std::vector<Found> testsOf(const std::string& name) {
  std::vector<Found> out;
  bool example = false;
  for (const link::ExperimentName& one : link::builtInSituations()) {
    if (name.empty()) out.push_back({one.name, {}});
    example = example || one.name == name;
  }
  std::error_code code;
  if (name.empty()) return out;
  const bool folder = std::filesystem::is_directory(name, code);
  if (!folder && (example || std::filesystem::exists(name, code))) return {{name, {}}};
  if (!folder && name.find_first_of("/.") == std::string::npos) {
    return {{name,
             Error{ErrorCode::NotFound,
                   "there is no such folder, file or example (--list prints the examples)", name}}};
  }
  std::set<std::filesystem::path> seen;
  collect(name, seen, out);
  std::ranges::sort(out, {}, &Found::path);
  if (out.empty()) {
    out.push_back({name, Error{ErrorCode::NotFound, "it contains no .json file", name}});
  }
  return out;
}

Result<link::ExperimentSummary> played(const link::Experiment& experiment,
                                       const TestOptions& options) {
  link::PlaySettings settings;
  settings.cancelled = &interrupted;
  settings.robotProgram = options.robotProgram.empty() ? link::besideTeamProgram("pitchboard-robot")
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

Result<link::TestedExperiment> tested(const Found& test, const TestOptions& options) {
  if (test.error) return tl::unexpected(*test.error);
  auto experiment = TRY(link::loadExperiment(test.path));
  const auto& tournament = experiment.tournament;
  if (experiment.assertions.empty() && (!tournament || tournament->assertions.empty())) {
    return failure(ErrorCode::InvalidArgument, "has no assertions, so it tests nothing", test.path);
  }
  auto summary = played(experiment, options);
  if (!summary) {
    return failure(summary.error().code, summary.error().text(), test.path);
  }
  return link::TestedExperiment{std::move(experiment), std::move(*summary), {}};
}

int runTests(const TestOptions& options) {
  const std::vector<Found> tests = testsOf(options.folder);
  const InterruptGuard signals;
  std::vector<link::TestedExperiment> all;
  std::size_t assertions = 0, failures = 0, errors = 0;
  for (const Found& test : tests) {
    auto one = tested(test, options);
    if (!one) {
      ++errors;
      reportError(one.error());
      link::TestedExperiment& unread = all.emplace_back();
      unread.experiment.name = test.path;
      unread.error = one.error().text();
      if (interrupted) break;
      continue;
    }
    for (const link::CheckedAssertion& checked : one->summary.assertions) {
      ++assertions;
      failures += !checked.holds;
      std::printf("%s  %s, %s: %s (%s)\n", checked.holds ? "holds " : "FAILED",
                  one->experiment.name.c_str(), checked.condition.c_str(), checked.text.c_str(),
                  checked.values.c_str());
      std::fflush(stdout);
    }
    all.push_back(std::move(*one));
  }
  std::printf("%zu %s, %zu %s, %zu failed", all.size(), all.size() == 1 ? "test" : "tests",
              assertions, assertions == 1 ? "assertion" : "assertions", failures);
  if (errors > 0) std::printf(", %zu with errors", errors);
  std::printf("\n");
  if (!options.junit.empty()) {
    const auto wrote = writeFile(options.junit, link::junitReport(all), IfExists::Replace);
    if (!wrote) return reportError(wrote.error());
  }
  return errors > 0 ? shared::exitRefused : failures == 0 ? 0 : 1;
}

}  // namespace

void addTestCommand(CLI::App& parent, int& exitCode) {
  auto options = std::make_shared<TestOptions>();
  TestOptions& o = *options;
  CLI::App* command = parent.add_subcommand(
      "test",
      "Play situations with assertions and print which pass. Exits with 1 if an assertion fails, "
      "with 2 if a file cannot be read or played; the others are still played.\n"
      "Examples: pitchboard-cli test situations --junit results.xml\n"
      "          pitchboard-cli test striker-scores");
  command
      ->add_option(
          "folder", o.folder,
          "A folder of experiment files (with its subfolders), one file, or the name of an "
          "example (--list); default: all examples")
      ->type_name("DIR|FILE|NAME");
  command->add_option("--junit", o.junit, "Write the results as JUnit XML, errors included")
      ->type_name("FILE.xml");
  command->add_option("--jobs", o.jobs, "Runs at the same time; default: one per processor")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--list", o.list, "List the examples");
  command
      ->add_option("--robot-program", o.robotProgram,
                   "Program of separate processes; default: pitchboard-robot beside this program")
      ->type_name("FILE");
  command->callback([options, &exitCode] {
    if (options->list) {
      for (const link::ExperimentName& one : link::builtInSituations()) {
        std::printf("%-24s %s\n", one.name.c_str(), one.title.c_str());
      }
      return;
    }
    exitCode = runTests(*options);
  });
}

}  // namespace pitchboard::cli
