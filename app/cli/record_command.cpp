// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/live_recorder.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <set>
#include <thread>

#include <base/try.h>
#include <robotlink/match/match_player.h>
#include <robotlink/session/match_recorder.h>
#include <telemetry/session/recording_health.h>

#include "commands.h"
#include "interrupt.h"
#include "listen_options.h"
#include "match_play.h"
#include "progress.h"

namespace pitchboard::cli {
namespace {

using namespace telemetry;
using Clock = std::chrono::steady_clock;

constexpr auto healthInterval = std::chrono::milliseconds(20);

struct RecordOptions {
  std::string output;
  MatchPlayOptions play;
  bool live = false, force = false, progress = false;
  OptionValues network;
};

Result<int> ended(const std::string& path, const SessionStatus& status,
                  const Result<void>& finished) {
  if (!finished) {
    return failure(finished.error().code, status.problem, finished.error().context);
  }
  std::printf("%s: %.3f s, %llu rows, %llu messages, %.3f MB", path.c_str(), status.seconds,
              static_cast<unsigned long long>(status.rows),
              static_cast<unsigned long long>(status.messages),
              static_cast<double>(status.bytes) / 1e6);
  if (status.dropped > 0) {
    std::printf("; %llu dropped, the disk was too slow",
                static_cast<unsigned long long>(status.dropped));
  }
  std::printf("\n");
  return 0;
}

/// How the recording goes, on stderr: with the progress, and what threatens it in any case.
class Health {
 public:
  explicit Health(bool progress) : m_progress("recording", progress) {}

  void showStatus(const SessionStatus& status) {
    const RecordingTrouble trouble = troubleOf(status);
    if (trouble != RecordingTrouble::None && m_reported.insert(trouble).second) {
      std::fprintf(stderr, "%swarning: %s\n", m_progress.fresh().c_str(),
                   troubleText(status).c_str());
    }
    char text[80];
    std::snprintf(text, sizeof text, "%.1f s, %.1f MB", status.seconds,
                  static_cast<double>(status.bytes) / 1e6);
    const std::string room = freeSpaceText(status);
    m_progress.show(text + (room.empty() ? room : ", " + room) +
                    (trouble == RecordingTrouble::DiskBehind ? ", disk cannot keep up" : ""));
  }

 private:
  Progress m_progress;
  std::set<RecordingTrouble> m_reported;
};

Result<int> recordMatch(const RecordOptions& options) {
  const auto cognition = shared::cognitionOf(options.play.robots);
  const auto scenario =
      TRY(scenarioToPlay(shared::scenarioFrom(options.play.match), options.play, cognition));
  const auto speed = TRY(speedOf(options.play, cognition, scenario));
  auto match = TRY(createMatch(scenario, options.play, cognition));

  SessionWriterOptions writing;
  writing.waitWhenFull = true;
  writing.replace = options.force;
  const std::shared_ptr<SessionWriter> writer = TRY(SessionWriter::create(
      options.output, link::sessionInfo(match, programName, LiveClock().now()), writing));
  link::attachMatch(*writer, match.scenario(), link::VariableCatalog::published());
  const auto sampler = std::make_shared<link::MatchSampler>();
  const auto recorder = std::make_shared<link::MatchRecorder>(writer, sampler);
  link::MatchPlayer player(std::move(match));
  player.observe(sampler);
  player.observe(recorder);
  Outcome outcome;
  {
    Health health(options.progress);
    outcome = playToEnd(player, speed, [&] {
      health.showStatus(writer->status());
      return writer->status().recording;
    });
  }
  const auto finished = recorder->finish();
  TRY(ended(writer->path(), writer->status(), finished));
  printResult(player.match(), outcome);
  return 0;
}

void warnOfNoRobot(const link::LiveDetails& details) {
  const auto arrived = static_cast<unsigned long long>(details.network.datagrams());
  if (arrived > 0) {
    std::fprintf(stderr,
                 "warning: no robot was recorded: of %llu datagrams none came from one; "
                 "pitchboard-cli listen shows what they are\n",
                 arrived);
  } else {
    std::fprintf(stderr,
                 "warning: no robot was recorded: nothing arrived; robots have to send to this "
                 "computer, or to everybody, on the ports above, and no firewall may stop them\n");
  }
}

Result<int> recordLive(const RecordOptions& options) {
  const link::LiveOptions live = TRY(liveOptions(options.network));
  link::LiveWatch watch(live);
  link::LiveDetails details = TRY(whenListening(watch));
  const auto& ports = details.network.ports;
  if (std::ranges::none_of(ports, [](const PortStatus& port) { return port.bound; })) {
    return failure(ErrorCode::SystemError, ports.front().problem, live.bind.text());
  }
  link::RecorderOptions recording;
  recording.program = programName;
  recording.writer.replace = options.force;
  const auto recorder =
      TRY(link::LiveRecorder::create(options.output, live, watch.began(), recording));
  watch.observe(recorder);
  reportListening(live, details.network);
  {
    Health health(options.progress);
    std::map<std::size_t, std::string> reported;
    std::map<std::string, std::string> reportedSources;
    const auto begin = Clock::now();
    const auto isOver = [&] {
      return options.play.duration &&
             Clock::now() - begin >= std::chrono::duration<double>(*options.play.duration);
    };
    while (!interrupted && !isOver() && recorder->status().recording) {
      const link::LiveDetails now = watch.details();
      reportPorts(now, reported);
      reportSources(now, reportedSources);
      health.showStatus(recorder->status());
      std::this_thread::sleep_for(healthInterval);
    }
  }
  watch.stopObserving(recorder);
  details = watch.details();
  const std::string refused = refusedText(details);
  if (!refused.empty()) std::fprintf(stderr, "%s\n", refused.c_str() + 2);
  const auto finished = recorder->finish();
  if (recorder->status().rows == 0) warnOfNoRobot(details);
  return ended(recorder->path(), recorder->status(), finished);
}

Result<int> record(RecordOptions& options) {
  const InterruptGuard signals;
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of writing, not the end
  if (options.output.empty()) {
    return failure(ErrorCode::InvalidArgument, "a recording needs a file: add -o FILE.mcap");
  }
  TRY(ifExists(options.output, options.force));
  return options.live ? recordLive(options) : recordMatch(options);
}

}  // namespace

void addRecordCommand(CLI::App& parent, int& exitCode) {
  auto options = std::make_shared<RecordOptions>();
  RecordOptions& o = *options;
  CLI::App* command = parent.add_subcommand(
      "record",
      "Record a simulated match or live robots. Simulated matches run as fast as possible unless "
      "--speed is given.\n"
      "Examples: pitchboard-cli record --scenario match-3v3 --duration 10:00 -o match.mcap\n"
      "          pitchboard-cli record --scenario match --referee humanoid-soccer-2026 -o "
      "final.mcap\n"
      "          pitchboard-cli record --live -o training.mcap\n"
      "          pitchboard-cli record --live --foxglove ws://robot3:8765 -o training.mcap");
  command->add_option("-o,--output", o.output, "Write this new recording")
      ->required()
      ->type_name("FILE.mcap");
  addForce(*command, o.force, "Replace an existing recording");
  shared::addDuration(
      *command, "--duration", o.play.duration,
      "Stop after this time; by default when the scenario says so, at the final whistle, or "
      "after 60 s of the match; live: at Ctrl+C");
  addPlayOptions(*command, o.play);
  CLI::Option* live =
      command->add_flag("--live", o.live, "Record what robots and the referee send");
  for (const char* ofAMatch :
       {"--scenario", "--seed", "--noise", "--physics", "--robot-model", "--speed", "--keep-speed",
        "--cognition", "--referee", "--obey-referee", "--answer-referee", "--match", "--key-base",
        "--pace", "--runtime", "--robot-program"}) {
    live->excludes(command->get_option(ofAMatch));
  }
  const std::size_t before = command->get_options().size();
  addListenOptions(*command, o.network);
  const auto all = command->get_options();
  for (std::size_t i = before; i < all.size(); ++i) all[i]->needs(live);
  addGroup(*command, "Live", {"--profile", "--team", "--our-team"});
  // Its help has the network's options, too, and stays on a screen.
  addGroup(*command, "Models", {"--robot-model"});
  addGroup(*command, "Robot processes", {"--runtime"});
  command->add_flag("--progress", o.progress,
                    "Print progress to stderr even if it is not a terminal");
  whenChosen(*command, options, exitCode, record);
}

}  // namespace pitchboard::cli
