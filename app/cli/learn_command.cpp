// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <filesystem>
#include <memory>

#include <base/try.h>
#include <robotlink/learn/learn.h>

#include "commands.h"
#include "experiment_play.h"
#include "interrupt.h"
#include "progress.h"

namespace pitchboard::cli {
namespace {

struct LearnOptions {
  std::string file;
  PlayInto play;
};

Result<int> learnTeam(const LearnOptions& options) {
  const auto learning = TRY(link::loadLearning(options.file));
  const Shard shard = TRY(shardFrom(options.play.shard));
  if (options.play.force) {
    if (shard.count > 1) {
      return failure(ErrorCode::InvalidArgument,
                     "--force cannot be used with --shard, because the shards share the folder; "
                     "remove the folder before you start them");
    }
    TRY(link::discardLearning(options.play.folder));
  }
  const InterruptGuard signals;
  Progress progress(learning.name, options.play.progress);
  link::LearnSettings settings{options.play.folder, shard.index, shard.count};
  settings.jobs = jobsFor(options.play, false);
  settings.resume = options.play.resume;
  settings.play.robotProgram = robotProgram(options.play.robotProgram);
  settings.play.cancelled = &interrupted;
  settings.program = programName;
  settings.progress = [&progress](const std::string& text) { progress.show(text); };
  const auto learned = TRY(link::learn(learning, settings));
  std::printf("%sChosen: %s\n", progress.fresh().c_str(), learned.from.c_str());
  const int ended = printSummary(learned.validation, learned.summary);
  if (shard.index == 1) {
    for (const char* name : {"best.json", "report.html"}) {
      std::printf("%s\n", (std::filesystem::path(options.play.folder) / name).c_str());
    }
  }
  return ended;
}

}  // namespace

void addLearnCommand(CLI::App& parent, int& exitCode) {
  auto options = std::make_shared<LearnOptions>();
  CLI::App* command = parent.add_subcommand(
      "learn",
      "Learn the numbers of a team's behaviours by playing matches, on all processors, and "
      "validate "
      "the result. Exits with 1 if an assertion of the validation fails.\n"
      "Examples: pitchboard-cli learn our-team.json --out learned\n"
      "          pitchboard-cli learn our-team.json --out shared/learned --shard 2/8");
  command->add_option("learning", options->file, "A JSON file (docs/learning.md)")
      ->required()
      ->type_name("FILE");
  addPlayInto(*command, options->play);
  command->get_option("--out")->required();
  command->get_option("--shard")->description(
      "Play only shard i of n; all shards use the same folder");
  whenChosen(*command, options, exitCode, learnTeam);
}

}  // namespace pitchboard::cli
