// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/match_recorder.h>
#include <telemetry/gamecontroller.h>
#include <telemetry/live_rows.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "interrupt.h"
#include "listen_options.h"
#include "live_json.h"
#include "progress.h"

namespace pitchboard::cli {
namespace {

using namespace telemetry;
using Clock = std::chrono::steady_clock;

constexpr double defaultDuration = 60.0;  // s simulated
constexpr auto reportInterval = std::chrono::milliseconds(250);
constexpr const char* program = "pitchboard " PITCHBOARD_VERSION;

struct Options {
  std::string output, scenario = "match-3v3", noise;
  std::optional<double> duration;
  std::optional<std::uint64_t> seed;
  bool live = false, progress = false;
  ListenOptions network;
};

int ended(SessionWriter& writer) {
  const auto finished = writer.finish();
  const SessionStatus status = writer.status();
  if (!finished) {
    return reportError({finished.error().code, status.problem, finished.error().context});
  }
  std::printf("%s: %.3f s, %llu rows, %llu messages, %.3f MB", writer.path().c_str(), status.seconds,
              static_cast<unsigned long long>(status.rows),
              static_cast<unsigned long long>(status.messages), static_cast<double>(status.bytes) / 1e6);
  if (status.dropped > 0) {
    std::printf("; %llu dropped, the disk was too slow", static_cast<unsigned long long>(status.dropped));
  }
  std::printf("\n");
  return 0;
}

std::string statusText(const SessionStatus& status) {
  char text[80];
  std::snprintf(text, sizeof text, "%.1f s, %.1f MB", status.seconds,
                static_cast<double>(status.bytes) / 1e6);
  return text;
}

/// Sees its match from outside the runner, as fast as it can be played.
int recordMatch(const Options& options) {
  auto scenario = link::loadScenario(options.scenario);
  if (!scenario) return reportError(scenario.error());
  if (options.seed) scenario->settings.seed = *options.seed;
  if (!options.noise.empty()) {
    const auto noise = link::noisePreset(options.noise);
    if (!noise) return reportError(noise.error());
    scenario->settings.noise = *noise;
  }
  scenario->stop.duration = options.duration.value_or(scenario->stop.duration.value_or(defaultDuration));
  auto match = link::SimulatedMatch::create(*scenario, {});
  if (!match) return reportError(match.error());

  SessionWriterOptions writing;
  writing.waitWhenFull = true;
  auto created = SessionWriter::create(options.output, link::sessionInfo(*match, program, wallNow()), writing);
  if (!created) return reportError(created.error());
  const std::shared_ptr<SessionWriter> writer = std::move(*created);
  link::attachMatch(*writer, match->scenario(), link::VariableCatalog::published());
  link::MatchRecorder recorder(writer);
  {
    Progress progress("recording", options.progress);
    recorder.ticked(*match, {});
    while (!interrupted && !match->finished() && writer->status().recording) {
      const auto begin = Clock::now();
      match->tick();
      const auto spent = Clock::now() - begin;
      if (!match->simulation().events().empty()) recorder.happened(match->simulation().events());
      recorder.ticked(*match, spent);
      progress.say(statusText(writer->status()));
    }
    (void)recorder.finish();   // its error is told below
  }
  return ended(*writer);
}

/// What arrives, as rows and as it came.
class LiveRecorder {
 public:
  LiveRecorder(std::shared_ptr<SessionWriter> writer, ListenSetup setup, WallTime zero, int refereePort)
      : m_writer(std::move(writer)),
        m_monitor(std::move(setup.profile), std::move(setup.monitor)),
        m_rows(m_writer, {zero, {}}),
        m_zero(zero),
        m_refereePort(static_cast<std::uint16_t>(refereePort)) {}

  void take(const DatagramBatch& batch) {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const DatagramView datagram = batch[i];
      const double time = std::chrono::duration<double>(datagram.time - m_zero).count();
      const bool referee = datagram.localPort == m_refereePort;
      if (!m_monitor.options().senders.allows(datagram.sender.address)) continue;
      m_writer->append(referee ? SessionStream::RefereeRaw : SessionStream::Telemetry,
                       {time, datagram.sender, datagram.localPort, std::string(datagram.payload)});
      if (referee) {
        if (const auto packet = decodeReferee(datagram.payload)) {
          Json json = refereeJson(*packet);
          json["time"] = time;
          m_writer->appendJson(SessionStream::Referee, time, dump(json));
        }
      } else if (m_monitor.take(datagram) == TeamMonitor::Verdict::Used) {
        m_rows.take(datagram, m_monitor.decoded(), m_monitor.decoder());
      }
    }
  }

  void report() { m_rows.report(m_monitor.status(wallNow())); }

 private:
  std::shared_ptr<SessionWriter> m_writer;
  TeamMonitor m_monitor;
  LiveRows m_rows;
  WallTime m_zero;
  std::uint16_t m_refereePort;
};

int recordLive(const Options& options) {
  auto setup = listenSetup(options.network);
  if (!setup) return reportError(setup.error());
  auto network = UdpReceiver::start(setup->receiver);
  if (!network) return reportError(network.error());
  SessionInfo info;
  info.program = program;
  info.source = "live";
  info.title = "live";
  info.start = info.created = wallNow();
  auto created = SessionWriter::create(options.output, info);
  if (!created) return reportError(created.error());
  const std::shared_ptr<SessionWriter> writer = std::move(*created);
  LiveRecorder recorder(writer, std::move(*setup), info.start, options.network.refereePort);
  sayListening(options.network);
  {
    Progress progress("recording", options.progress);
    std::map<std::size_t, std::string> told;
    DatagramBatch batch;
    const auto begin = Clock::now();
    auto nextReport = begin;
    while (!interrupted && writer->status().recording) {
      const auto now = Clock::now();
      if (options.duration && now - begin >= std::chrono::duration<double>(*options.duration)) break;
      if (now >= nextReport) {
        reportPorts((*network)->status(), told);
        recorder.report();
        nextReport = now + reportInterval;
      }
      if ((*network)->take(batch, std::chrono::milliseconds(50))) recorder.take(batch);
      progress.say(statusText(writer->status()));
    }
    (*network)->stop();
    if ((*network)->take(batch)) recorder.take(batch);
  }
  return ended(*writer);
}

int run(Options& options) {
  const InterruptGuard signals;
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of writing, not the end
  if (!options.output.empty()) return options.live ? recordLive(options) : recordMatch(options);
  return reportError({ErrorCode::InvalidArgument, "Say where to: -o FILE.mcap", {}});
}

}  // namespace

void addRecordCommand(CLI::App& parent, int& exitCode) {
  auto options = std::make_shared<Options>();
  Options& o = *options;
  CLI::App* command = parent.add_subcommand(
      "record",
      "Play a match as fast as possible, or listen to live robots, and record everything.\n"
      "Examples: pitchboard-cli record --scenario match-3v3 --duration 600 -o match.mcap\n"
      "          pitchboard-cli record --live -o training.mcap");
  command->add_option("-o,--output", o.output, "A new session")->required()->type_name("FILE.mcap");
  command->add_option("--duration", o.duration,
                      "Seconds; without it the scenario's, else 60; live: until Ctrl+C")
      ->check(CLI::Range(0.001, 1e9));
  command->add_option("--scenario", o.scenario, "Built-in name or a JSON file")
      ->type_name("NAME|FILE")->capture_default_str();
  command->add_option("--seed", o.seed, "Seed of all noise; default: the scenario's")->type_name("N");
  command->add_option("--noise", o.noise, "none, published, paper or realistic")->type_name("PRESET");
  command->add_flag("--live", o.live, "Record what robots and the referee send");
  addListenOptions(*command, o.network);
  command->add_flag("--progress", o.progress, "Say on stderr how far it is, also without a terminal");
  command->callback([options, &exitCode] { exitCode = run(*options); });
}

}  // namespace pitchboard::cli
