// SPDX-License-Identifier: GPL-3.0-or-later
// `serve`: shows a session, a simulated match or live robots to programs that speak Foxglove's
// protocol.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <app/usage.h>
#include <base/try.h>
#include <robotlink/serve/served_session.h>
#include <robotlink/session/match_recorder.h>
#include <telemetry/foxglove/foxglove_server.h>
#include <telemetry/session/session_time.h>
#include <telemetry/sockets/live_clock.h>

#include "commands.h"
#include "interrupt.h"
#include "listen_options.h"
#include "match_play.h"

namespace pitchboard::cli {
namespace {

using telemetry::FoxglovePlaybackControl;
using telemetry::FoxglovePlaybackState;
using telemetry::FoxgloveServer;
using telemetry::FoxgloveServerOptions;
using SteadyClock = std::chrono::steady_clock;

struct ServeOptions {
  MatchPlayOptions play;
  std::string session, at, address = "127.0.0.1";
  int port = 8765;
  double rate = 20.0;  // Hz
  bool paused = false, live = false;
  OptionValues network;
};

std::uint64_t nanosecondsOf(telemetry::WallTime time) {
  return static_cast<std::uint64_t>(time.time_since_epoch().count());
}

/// A client begins anew when this changes.
std::string newSessionId() {
  return std::to_string(nanosecondsOf(telemetry::LiveClock().now()));
}

Result<FoxgloveServerOptions> serverOptions(const ServeOptions& options, std::string title) {
  FoxgloveServerOptions out;
  out.bind = TRY(telemetry::parseAddress(options.address));
  out.port = static_cast<std::uint16_t>(options.port);
  out.name = std::move(title);
  out.sessionId = newSessionId();
  return out;
}

void reportServing(const ServeOptions& options, const FoxgloveServer& server) {
  const std::string host =
      options.address == "0.0.0.0" ? "this computer's address" : options.address;
  std::fprintf(stderr, "serving on ws://%s:%d (Ctrl+C ends)\n", host.c_str(), server.port());
}

/// Plays a session as clients ask. Main thread, except ask().
class SessionPlaying {
 public:
  SessionPlaying(const telemetry::SessionReader& session, double speed, bool paused)
      : m_session(session), m_speed(speed), m_plays(!paused) {}

  /// Called on the server's thread.
  void ask(const FoxglovePlaybackControl& control) {
    const std::lock_guard lock(m_mutex);
    m_asked.push_back(control);
  }

  void play(FoxgloveServer& server, double at, double rate) {
    link::ServedSession served(m_session, server);
    const auto step = std::chrono::duration<double>(1.0 / rate);
    served.show(at);
    tell(server, served, {});
    for (auto before = SteadyClock::now(); !interrupted;) {
      const bool wasAsked = carryOut(server, served);
      const auto now = SteadyClock::now();
      const double passed = std::chrono::duration<double>(now - before).count();
      before = now;
      if (m_plays && !wasAsked) {
        served.playTo(served.time() + passed * m_speed, [] { return !interrupted; });
      }
      if (m_plays && served.time() >= served.range().end) {
        m_plays = false;
        tell(server, served, {});
      }
      std::this_thread::sleep_for(step);
    }
  }

 private:
  bool carryOut(FoxgloveServer& server, link::ServedSession& served) {
    std::vector<FoxglovePlaybackControl> asked;
    {
      const std::lock_guard lock(m_mutex);
      asked.swap(m_asked);
    }
    for (const FoxglovePlaybackControl& one : asked) {
      m_plays = one.plays;
      m_speed = one.speed;
      if (one.seek) {
        served.show(m_session.seconds(*one.seek));
      } else if (m_plays && served.time() >= served.range().end) {
        served.show(served.range().begin);  // again from the beginning
      }
      tell(server, served, one);
    }
    return !asked.empty();
  }
  void tell(FoxgloveServer& server, const link::ServedSession& served,
            const FoxglovePlaybackControl& asked) const {
    FoxglovePlaybackState state = served.playback(m_plays, m_speed);
    state.didSeek = asked.seek.has_value();
    state.requestId = asked.requestId;
    server.setPlayback(state);
  }

  const telemetry::SessionReader& m_session;
  double m_speed;
  bool m_plays;
  std::mutex m_mutex;
  std::vector<FoxglovePlaybackControl> m_asked;
};

Result<int> serveSession(const ServeOptions& options) {
  const auto session = TRY(telemetry::SessionReader::open(options.session));
  for (const std::string& note : session.notes()) std::fprintf(stderr, "note: %s\n", note.c_str());
  if (session.isForeign()) {
    return failure(ErrorCode::Unsupported,
                   "another program recorded this; make a session of it first: pitchboard-cli "
                   "import FILE -o SESSION",
                   options.session);
  }
  const auto range = session.range();
  if (!range) return failure(ErrorCode::NotFound, "The recording is empty.", options.session);
  double at = range->begin;
  if (!options.at.empty()) {
    auto given = telemetry::sessionTime(options.at, session.info().start, *range);
    if (!given) return failure(given.error().code, "--at: " + given.error().message);
    at = *given;
  }
  const std::string& speedText = options.play.robots.speed;
  const double speed = speedText.empty() ? 1.0 : TRY(shared::speedFrom(speedText));
  if (speed <= 0.0) {
    return failure(ErrorCode::InvalidArgument, "--speed of a recording must be a number, not max");
  }
  SessionPlaying playing(session, speed, options.paused);
  auto server = TRY(serverOptions(options, session.info().title));
  server.playback = {session.logTime(range->begin), session.logTime(range->end)};
  server.control = [&playing](const FoxglovePlaybackControl& control) { playing.ask(control); };
  const auto running = TRY(FoxgloveServer::start(server));
  reportServing(options, *running);
  playing.play(*running, at, options.rate);
  return 0;
}

Result<int> serveMatch(const ServeOptions& options) {
  MatchPlayOptions play = options.play;
  if (play.robots.speed.empty()) play.robots.speed = "1";
  const auto cognition = shared::cognitionOf(play.robots);
  const auto scenario = TRY(scenarioToPlay(shared::scenarioFrom(play.match), play, cognition));
  const auto speed = TRY(speedOf(play, cognition, scenario));
  auto match = TRY(createMatch(scenario, play, cognition));
  const auto info = link::sessionInfo(match, programName, telemetry::LiveClock().now());
  const auto server = TRY(serverOptions(options, info.title));
  const auto running = TRY(FoxgloveServer::start(server));
  const auto served = std::make_shared<link::ServedMatch>(*running, link::logTimesFrom(info.start));
  const double tickRate = match.simulation().state().settings.tickRate;
  const int everyNth = std::max(1, static_cast<int>(std::lround(tickRate / options.rate)));
  link::MatchPlayer player(std::move(match));
  player.observe(std::make_shared<link::MatchSampler>(
      served, link::MatchSamplerOptions{.everyNth = everyNth}));
  player.observe(std::make_shared<link::MatchServing>(served, everyNth));
  reportServing(options, *running);
  const Outcome outcome = playToEnd(player, speed, [] { return true; });
  std::fprintf(stderr, "The match is over (%s).\n", outcome.finishedBy.c_str());
  return 0;
}

Result<int> serveLive(const ServeOptions& options) {
  const link::LiveOptions live = TRY(liveOptions(options.network));
  link::LiveWatch watch(live);
  const link::LiveDetails details = TRY(whenListening(watch));
  const auto server = TRY(serverOptions(options, "Pitchboard Live"));
  const auto running = TRY(FoxgloveServer::start(server));
  const auto served =
      std::make_shared<link::ServedMatch>(*running, link::logTimesFrom(watch.began()));
  const auto serving = std::make_shared<link::LiveServing>(served);
  watch.observe(serving);
  reportListening(live, details.network);
  reportServing(options, *running);
  std::map<std::size_t, std::string> reported;
  while (!interrupted) {
    reportPorts(watch.details(), reported);
    watch.take();  // asks for the next frame
    std::this_thread::sleep_for(std::chrono::duration<double>(1.0 / options.rate));
  }
  watch.stopObserving(serving);
  return 0;
}

Result<int> serve(const ServeOptions& options) {
  const InterruptGuard signals;
  if (options.live) return serveLive(options);
  return options.session.empty() ? serveMatch(options) : serveSession(options);
}

}  // namespace

void addServeCommand(CLI::App& parent, int& exitCode) {
  auto options = std::make_shared<ServeOptions>();
  ServeOptions& o = *options;
  CLI::App* command = parent.add_subcommand(
      "serve",
      "Show a recording or a match to Foxglove and others. Lichtblick and PlotJuggler speak the "
      "same protocol. They get rows, events, log and the field, and play a recording.\n"
      "Examples: pitchboard-cli serve match.mcap\n"
      "          pitchboard-cli serve --scenario match-3v3 --duration 10:00\n"
      "          pitchboard-cli serve --live --address 0.0.0.0");
  CLI::Option* session = command->add_option("SESSION", o.session, "A recording (session)");
  command->add_option("--port", o.port, "TCP port; 0: a free one")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command
      ->add_option("--address", o.address,
                   "Address to listen on; 0.0.0.0: every computer in the network may look")
      ->type_name("ADDRESS")
      ->capture_default_str();
  command->add_option("--rate", o.rate, "Pictures of the field, and rows of a match, per second")
      ->check(CLI::Range(1.0, 60.0))
      ->type_name("HZ")
      ->capture_default_str();
  command->add_option("--at", o.at, "Start a recording at this time")
      ->type_name("TIME")
      ->needs(session);
  command->add_flag("--paused", o.paused, "Start a recording paused")->needs(session);
  shared::addDuration(*command, "--duration", o.play.duration,
                      "Length of the match; default: until the scenario or the referee ends it, or "
                      "60 s");
  addPlayOptions(*command, o.play);
  CLI::Option* live = command->add_flag("--live", o.live, "Show live robots")->excludes(session);
  for (const char* ofAMatch :
       {"--scenario", "--seed", "--noise", "--physics", "--robot-model", "--keep-speed",
        "--cognition", "--referee", "--obey-referee", "--answer-referee", "--match", "--key-base",
        "--pace", "--runtime", "--robot-program", "--duration"}) {
    live->excludes(command->get_option(ofAMatch));
    session->excludes(command->get_option(ofAMatch));
  }
  live->excludes(command->get_option("--speed"));
  const std::size_t before = command->get_options().size();
  addListenOptions(*command, o.network);
  const auto all = command->get_options();
  for (std::size_t i = before; i < all.size(); ++i) all[i]->needs(live);
  addGroup(*command, "Live", {"--profile", "--team", "--our-team"});
  addGroup(*command, "Models", {"--robot-model", "--seed"});
  addGroup(*command, "Robot processes", {"--runtime", "--cognition"});
  whenChosen(*command, options, exitCode, serve);
}

}  // namespace pitchboard::cli
