// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/session/session_time.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <thread>

#include <base/try.h>
#include <robotlink/explore/explore.h>
#include <robotlink/session/match_recorder.h>
#include <robotlink/session/moment_reader.h>
#include <robotlink/session/recorded_frame.h>

#include "commands.h"
#include "interrupt.h"
#include "progress.h"

namespace pitchboard::cli {
namespace {

using Json = nlohmann::ordered_json;

struct ExploreCommand {
  std::string file, at;
  double seconds = 30.0;
  std::size_t rollouts = 1000;
  std::uint64_t seed = 1;
  bool truth = false, json = false, progress = false;
};

struct Explored {
  double time = 0.0;
  link::ExploreStart start;
  link::ExploreResult result;
};

Result<std::optional<link::Scenario>> scenarioOf(const telemetry::SessionReader& session) {
  const auto text = session.attachment(link::scenarioAttachment);
  if (!text || text->empty()) return std::optional<link::Scenario>();
  return std::optional(TRY(link::scenarioFromJson(*text, "the recording's scenario")));
}

Result<Explored> exploreFile(const ExploreCommand& command) {
  Progress progress("exploring", command.progress);
  telemetry::McapReaderOptions reading;
  reading.progress = [](double) { return !interrupted; };
  const auto session = TRY(telemetry::SessionReader::open(command.file, reading));
  const auto range = session.range();
  if (!range) return failure(ErrorCode::NotFound, "the recording is empty", command.file);
  Explored made;
  const auto time = telemetry::sessionTime(command.at, session.info().start, *range);
  if (!time) return failure(time.error().code, "--at: " + time.error().message);
  made.time = *time;
  link::RecordedFrames frames(link::backdropOf(session));
  const link::MatchFrame frame = frames.frameAt(session, made.time);
  auto scenario = TRY(scenarioOf(session));
  if (scenario) link::setGameOf(link::stateOfFrame(session, frame), *scenario);
  link::ExploreStartOptions options;
  options.useTruth = command.truth;
  options.base = scenario ? &*scenario : nullptr;
  options.earlier = [&](double earlier) -> std::shared_ptr<const link::MatchFrame> {
    if (earlier < range->begin) return nullptr;
    return std::make_shared<const link::MatchFrame>(frames.frameAt(session, earlier));
  };
  if (command.truth && !frame.truthKnown) {
    return failure(ErrorCode::InvalidArgument,
                   "--truth needs a recording of a simulated match; leave it out", command.file);
  }
  made.start = TRY(link::exploreStart(frame, options));
  link::ExploreOptions explore;
  explore.seconds = command.seconds;
  explore.maxRollouts = command.rollouts;
  explore.seed = command.seed;
  explore.threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 64U));
  made.result = TRY(link::explore(
      made.start, explore,
      [&progress](double done, const link::ExploreResult&) { return progress(done); },
      &interrupted));
  if (interrupted) return failure(ErrorCode::Conflict, "Cancelled.");
  return made;
}

Json shareJson(const link::Share& share) {
  return {{"value", share.value}, {"low", share.low}, {"high", share.high}};
}

Json exploredJson(const ExploreCommand& command, const Explored& explored) {
  const link::ExploreResult& result = explored.result;
  Json out{{"file", command.file},
           {"at", explored.time},
           {"seconds", result.seconds},
           {"rollouts", result.rollouts},
           {"seed", command.seed},
           {"robots", explored.start.names},
           {"notes", explored.start.notes},
           {"goal_left", shareJson(result.last().goalLeft)},
           {"goal_right", shareJson(result.last().goalRight)}};
  out["heat"] = {{"columns", result.columns}, {"rows", result.rows}, {"times", Json::array()}};
  for (std::size_t i = 0; i < result.times.size(); ++i) {
    const link::ExploredTime& time = result.times[i];
    out["heat"]["times"].push_back({{"time", i},
                                    {"goal_left", shareJson(time.goalLeft)},
                                    {"goal_right", shareJson(time.goalRight)},
                                    {"cells", time.heat}});
  }
  return out;
}

void printExplored(const Explored& explored) {
  const link::ExploreResult& result = explored.result;
  for (const std::string& note : explored.start.notes) std::printf("%s\n", note.c_str());
  std::printf("\n%zu rollouts of %.0f s from %.2f s\n", result.rollouts, result.seconds,
              explored.time);
  const auto goal = [](const char* team, const link::Share& share) {
    std::printf("%-32s %5.1f %%   (95 %%: %.1f to %.1f)\n", team, 100.0 * share.value,
                100.0 * share.low, 100.0 * share.high);
  };
  goal("Goal of the left team", result.last().goalLeft);
  goal("Goal of the right team", result.last().goalRight);
}

Result<int> exploreMoment(const ExploreCommand& command) {
  const InterruptGuard signals;
  const Explored explored = TRY(exploreFile(command));
  if (command.json) {
    std::printf("%s\n", exploredJson(command, explored).dump().c_str());
  } else {
    printExplored(explored);
  }
  return 0;
}

}  // namespace

void addExploreCommand(CLI::App& parent, int& exitCode) {
  auto options = std::make_shared<ExploreCommand>();
  CLI::App* command = parent.add_subcommand(
      "explore",
      "Explore what may follow a moment of a recording: where the ball goes, and how likely goals "
      "are.\n"
      "Example: pitchboard-cli explore match.mcap --at 1:18.7");
  command->add_option("file", options->file, "The recording")->required()->type_name("FILE");
  command->add_option("--at", options->at, "The moment to explore")->required()->type_name("T");
  command->add_option("--seconds", options->seconds, "Length of a rollout in seconds")
      ->type_name("S")
      ->check(CLI::Range(1.0, 600.0))
      ->capture_default_str();
  command
      ->add_option("--rollouts", options->rollouts,
                   "Largest number of rollouts; fewer if the result is precise enough earlier")
      ->type_name("N")
      ->check(CLI::Range(std::size_t{2}, std::size_t{1'000'000}))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Seed of the first rollout")
      ->type_name("N")
      ->capture_default_str();
  command->add_flag("--truth", options->truth,
                    "Start from the true positions of a simulated match instead of what the robots "
                    "believed");
  command->add_flag("--json", options->json, "Print JSON, with the heat maps of the ball");
  command->add_flag("--progress", options->progress,
                    "Print progress to stderr even if it is not a terminal");
  whenChosen(*command, options, exitCode, exploreMoment);
}

}  // namespace pitchboard::cli
