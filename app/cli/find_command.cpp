// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/query/find_moments.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <base/csv_field.h>
#include <base/try.h>

#include "commands.h"
#include "interrupt.h"
#include "progress.h"
#include "session_options.h"

namespace pitchboard::cli {
namespace {

using namespace telemetry;

struct FindCommand {
  std::vector<std::string> places;  // files and folders, and at the end the condition
  std::optional<double> least;
  std::vector<std::string> robots;
  bool json = false, csv = false, progress = false;
  int jobs = 0;
};

void print(const std::string& file, const FoundMoment& moment, const FindCommand& command) {
  if (command.json) {
    nlohmann::ordered_json line{{"session", file},
                                {"robot", moment.robot},
                                {"from", moment.range.begin},
                                {"until", moment.range.end}};
    if (moment.value) {
      line["value"] = *moment.value;
      line["value_time"] = moment.valueAt;
    }
    std::printf(
        "%s\n",
        line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
  } else if (command.csv) {
    std::printf("%s,%s,%.9g,%.9g,", csvField(file).c_str(), csvField(moment.robot).c_str(),
                moment.range.begin, moment.range.end);
    if (moment.value) std::printf("%.9g,%.9g", *moment.value, moment.valueAt);
    std::printf("%s\n", moment.value ? "" : ",");
  } else {
    std::printf("%s: %s %.3f to %.3f s (%.3f s)", file.c_str(), moment.robot.c_str(),
                moment.range.begin, moment.range.end, moment.range.end - moment.range.begin);
    if (moment.value) std::printf(", worst %.4g at %.3f s", *moment.value, moment.valueAt);
    std::printf("\n");
  }
}

Result<int> findIn(const FindCommand& command) {
  if (command.places.size() < 2) {
    return failure(ErrorCode::InvalidArgument,
                   "Give a folder or files, and then the condition, such as 'BELIEF_ERROR > 50'.");
  }
  FindOptions options;
  options.questions = {{command.places.back(), command.least.value_or(0.0), command.robots}};
  options.threads = static_cast<unsigned>(command.jobs);
  TRY(checkQuestion(options.questions.front()));
  const std::vector<std::string> files =
      TRY(recordingsOf({command.places.begin(), command.places.end() - 1}));
  const InterruptGuard signals;
  Progress progress("searching", command.progress);
  std::size_t moments = 0, unanswered = 0;
  bool hasFailed = false;
  std::optional<Error> noVariable;
  if (command.csv) std::printf("session,robot,from,until,value,value_time\n");
  const auto report = [&](std::size_t index, FileMoments&& found) {
    const std::string& file = files[index];
    const std::string fresh = progress.fresh();
    if (!found.unanswered.empty()) {
      // A session of other robots may have nothing similar.
      const Error& error = found.unanswered.front().error;
      if (!noVariable || error.message.find("did you mean") != std::string::npos)
        noVariable = error;
    }
    unanswered += found.isForeign || !found.unanswered.empty();
    hasFailed = !reportReading(file, found, fresh) || hasFailed;
    moments += found.moments.size();
    for (const FoundMoment& moment : found.moments) print(file, moment, command);
    std::fflush(stdout);
    (void)progress(static_cast<double>(index + 1) / static_cast<double>(files.size()));
    return !interrupted;
  };
  TRY(findMoments(files, options, report, [] { return !interrupted; }));
  if (interrupted) return failure(ErrorCode::Conflict, "Stopped before every file was read.");
  if (noVariable && unanswered == files.size()) return tl::unexpected(*noVariable);
  if (noVariable) {
    std::fprintf(stderr, "%snote: %zu of %zu recordings do not have these variables or robots.\n",
                 progress.fresh().c_str(), unanswered, files.size());
  }
  if (hasFailed) return shared::exitRefused;
  return moments > 0 ? 0 : 1;
}

}  // namespace

void addFindCommand(CLI::App& parent, int& exitCode) {
  auto options = std::make_shared<FindCommand>();
  CLI::App* command = parent.add_subcommand(
      "find",
      "List the moments at which a condition holds. It reads one or many recordings. The condition "
      "is an "
      "expression as in plots; a variable without a robot is that of each robot.\n"
      "Exits with 0 if there are such moments, with 1 if there are none, and with 2 if a file "
      "cannot be read, at least in part.\n"
      "Examples: pitchboard-cli find matches/ 'BELIEF_ERROR > 50 && VISION_BALL_DIST < 100' --for "
      "0.5\n"
      "          pitchboard-cli find match.mcap 'B1.VISION_LOST == 1' --for 5 --json\n"
      "          pitchboard-cli find *.mcap 'match.BALL_X > 4' --csv > near-the-goal.csv");
  command
      ->add_option("PLACE", options->places,
                   "Recordings or folders with recordings (*.mcap), and at the end the condition")
      ->required();
  shared::addDuration(*command, "--for", options->least,
                      "Only moments at which it holds for at least this long");
  addRobots(*command, options->robots, "Only these robots, e.g. B1,R2");
  command->add_flag("--json", options->json, "One JSON object per moment");
  command->add_flag("--csv", options->csv, "A line with commas per moment, and a header")
      ->excludes("--json");
  addReading(*command, options->jobs, options->progress);
  whenChosen(*command, options, exitCode, findIn);
}

}  // namespace pitchboard::cli
