// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include <app/robots_options.h>
#include <app/scenario_options.h>
#include <robotlink/match/match_player.h>
#include <robotlink/match/simulated_match.h>
#include <robotlink/processes/own_program.h>
#include <robotlink/scenario/referee_rule_sets.h>
#include <robotlink/session/match_recorder.h>
#include <robotlink/session/moment_reader.h>

#include "commands.h"
#include "interrupt.h"
#include "simulate_report.h"
#include "simulate_stdio.h"
#include "trace_writer.h"

namespace pitchboard::cli {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr double defaultDuration = 60.0;  // s simulated
constexpr auto pollInterval = 50ms;
constexpr auto progressInterval = 500ms;

struct Arguments {
  shared::ScenarioOptions match;
  std::string session;
  double at = 0.0;
  std::optional<double> duration;
  std::string speed;
  std::string cognition = "inline";
  std::string trace;
  std::string moment;
  std::string robotProgram;
  shared::RobotsOptions robots;
  bool force = false;
  bool json = false;
  bool list = false;
  bool stdio = false;
  std::string rules;
  std::optional<int> obeyReferee;
};

struct CognitionName {
  const char* name;
  link::Cognition cognition;
};
constexpr std::array<CognitionName, 3> cognitions{{{"inline", link::Cognition::Inline},
                                                   {"external", link::Cognition::External},
                                                   {"none", link::Cognition::None}}};

/// 0 = as fast as possible.
Result<double> speedFrom(const Arguments& arguments, link::Cognition cognition) {
  const std::string& text = arguments.speed;
  if (text.empty()) return cognition == link::Cognition::Inline ? 0.0 : 1.0;
  if (text == "max") return 0.0;
  const std::optional<double> speed = shared::numberFrom(text);
  if (!speed || !(*speed >= 0.001 && *speed <= 1e6)) {
    return failure(ErrorCode::InvalidArgument,
                   "--speed must be \"max\" or a number from 0.001 to 1000000 (1 = real time)");
  }
  return *speed;
}

/// A recorded match, and the moment from which it is to go on.
struct Recorded {
  link::Scenario scenario;
  link::Moment moment;
  double seconds() const {
    return static_cast<double>(moment.state.tick) / moment.state.settings.tickRate;
  }
};

Result<Recorded> recordedMoment(const Arguments& arguments) {
  const auto session = telemetry::SessionReader::open(arguments.session);
  if (!session) return tl::unexpected(session.error());
  auto moment = link::momentFromSession(*session, arguments.at, link::VariableCatalog::published());
  if (!moment) {
    Error error = moment.error();
    error.context =
        error.context.empty() ? arguments.session : arguments.session + ": " + error.context;
    return tl::unexpected(error);
  }
  const auto text = session->attachment(link::scenarioAttachment);
  if (!text) {
    return failure(ErrorCode::NotFound,
                   "this session has no scenario, so that nobody knows the match",
                   arguments.session);
  }
  auto scenario = link::scenarioFromJson(*text, arguments.session + ": scenario.json");
  if (!scenario) return tl::unexpected(scenario.error());
  return Recorded{std::move(*scenario), std::move(*moment)};
}

Result<link::Scenario> scenarioFrom(const Arguments& arguments, link::Cognition cognition,
                                    const std::optional<Recorded>& recorded) {
  auto scenario = recorded ? shared::changed(recorded->scenario, arguments.match)
                           : shared::scenarioFrom(arguments.match);
  if (!scenario) return scenario;
  if (!arguments.rules.empty()) {
    auto rules = link::refereeRuleSet(arguments.rules);
    if (!rules) return tl::unexpected(rules.error());
    scenario->settings.referee = *rules;
  }
  if (arguments.duration) {
    if (!(*arguments.duration > 0.0 && *arguments.duration <= 1e9)) {
      return failure(ErrorCode::InvalidArgument,
                     "--duration must be above 0 and at most 1e9 seconds");
    }
    scenario->stop.duration = arguments.duration;
  } else if (scenario->stop == link::StopConditions{} && cognition != link::Cognition::None &&
             !(scenario->settings.referee && scenario->settings.referee->automatic)) {
    scenario->stop.duration = defaultDuration;
  }
  if (recorded) {
    // Seconds from here on; a match that was over by then goes on all the same.
    auto& duration = scenario->stop.duration;
    const double now = recorded->seconds();
    if (arguments.duration) {
      duration = now + *arguments.duration;
    } else if (duration && *duration <= now + defaultDuration / 60.0) {
      duration = now + defaultDuration;
    }
  }
  return scenario;
}

/// An old file is refused with the option that allows it.
tl::unexpected<Error> cannotWrite(Error error, const Arguments& arguments) {
  if (error.code == ErrorCode::Conflict && !isSameFile(error.context, arguments.session)) {
    error.message = "This file exists; choose another name or add --force.";
  }
  return tl::unexpected(std::move(error));
}

/// Writes a row of the trace after every tick, until the system refuses one.
class TraceRows : public link::TickObserver {
 public:
  explicit TraceRows(TraceWriter writer) : m_writer(std::move(writer)) {}
  void ticked(const link::SimulatedMatch& match, std::chrono::nanoseconds /*tickTime*/) override {
    if (!m_written) return;
    match.simulation().snapshot(m_snapshot);
    m_written = m_writer.add(m_snapshot);
  }
  const Result<void>& written() const { return m_written; }
  Result<void> finish() { return m_written ? m_writer.finish() : m_written; }

 private:
  TraceWriter m_writer;
  sim::Snapshot m_snapshot;
  Result<void> m_written;
};

/// Says which processes ended before the match did, or do not play with it.
class ProcessNews : public link::TickObserver {
 public:
  void ticked(const link::SimulatedMatch& /*match*/, std::chrono::nanoseconds /*time*/) override {}
  void happened(std::span<const link::MatchEvent> events) override {
    for (const link::MatchEvent& event : events) {
      using Kind = link::MatchEventKind;
      constexpr std::array told{
          Kind::ProcessDied,    Kind::ProcessEnded,    Kind::ProcessRestarted,  Kind::ProcessSilent,
          Kind::ProcessGivenUp, Kind::ProcessRealTime, Kind::ProcessNotAttached};
      if (std::find(told.begin(), told.end(), event.kind) == told.end()) continue;
      std::fprintf(stderr, "%s%s\n", link::info(event.kind).warning ? "warning: " : "",
                   link::sentenceOf(event).c_str());
    }
  }
};

/// Plays the match to its end and looks after its processes.
class Playing {
 public:
  Playing(link::MatchPlayer& player, double speed)
      : m_player(player), m_match(player.match()), m_begin(Clock::now()) {
    m_player.setSpeed(speed, m_begin);
    m_match.setPlaying(speed, false, m_begin);
  }

  /// Ends early when `trace` cannot be written.
  Outcome play(const TraceRows* trace) {
    const std::uint64_t first = m_player.currentTick();
    while (!interrupted && !m_match.finished() && (!trace || trace->written())) {
      const auto next = m_player.play(Clock::now()).next;
      lookAfter();
      const auto now = Clock::now();
      if (next > now) std::this_thread::sleep_until(std::min(next, now + pollInterval));
    }
    if (m_showsProgress) std::fprintf(stderr, "\r\033[K");
    Outcome outcome;
    outcome.ticks = m_player.currentTick() - first;
    outcome.simulatedSeconds =
        static_cast<double>(outcome.ticks) / m_match.simulation().state().settings.tickRate;
    outcome.wallSeconds = std::chrono::duration<double>(Clock::now() - m_begin).count();
    outcome.finishedBy = m_match.finished() ? std::string(m_match.finishedBy()) : "interrupted";
    outcome.noise = noiseName(m_match.simulation().state().settings.noise);
    return outcome;
  }

 private:
  void lookAfter() {
    const auto now = Clock::now();
    if (now - m_lastPoll >= pollInterval) {
      m_lastPoll = now;
      pollProcesses();
    }
    if (m_showsProgress && now - m_lastProgress >= progressInterval) {
      m_lastProgress = now;
      const double rate = m_match.simulation().state().settings.tickRate;
      std::fprintf(stderr, "\r%.1f s simulated",
                   static_cast<double>(m_player.currentTick()) / rate);
    }
  }

  void pollProcesses() {
    m_match.lookAfterProcesses(Clock::now());
    (void)m_match.processes().takeLines();
    m_player.tellEvents();
  }

  link::MatchPlayer& m_player;
  link::SimulatedMatch& m_match;
  Clock::time_point m_begin, m_lastPoll, m_lastProgress;
  bool m_showsProgress = ::isatty(STDERR_FILENO) == 1;
};

Result<void> simulate(const Arguments& arguments) {
  const auto cognition = std::find_if(cognitions.begin(), cognitions.end(),
                                      [&](const auto& c) { return arguments.cognition == c.name; });
  if (cognition == cognitions.end()) {
    return failure(
        ErrorCode::InvalidArgument,
        "--cognition must be inline, external or none, not \"" + arguments.cognition + "\"");
  }
  const auto speed = speedFrom(arguments, cognition->cognition);
  if (!speed) return tl::unexpected(speed.error());
  std::optional<Recorded> recorded;
  if (!arguments.session.empty()) {
    auto read = recordedMoment(arguments);
    if (!read) return tl::unexpected(read.error());
    recorded = std::move(*read);
  }
  auto scenario = scenarioFrom(arguments, cognition->cognition, recorded);
  if (scenario) scenario = shared::withRuntimes(std::move(*scenario), arguments.robots);
  if (!scenario) return tl::unexpected(scenario.error());

  shared::warnOfIgnoredSettings(*scenario);
  link::MatchOptions options;
  options.cognition = cognition->cognition;
  shared::apply(arguments.robots, options);
  options.robotProgram = arguments.robotProgram.empty() ? link::besideOwnProgram("pitchboard-robot")
                                                        : arguments.robotProgram;
  options.obeyReferee = arguments.obeyReferee;
  options.speed = *speed;
  const InterruptGuard signals;
  auto match = link::SimulatedMatch::create(*scenario, options);
  if (!match) return tl::unexpected(match.error());
  if (const std::string notice = shared::numberNotice(*match); !notice.empty()) {
    std::fprintf(stderr, "%s\n", notice.c_str());
  }
  if (recorded) {
    if (auto entered = match->reenter(recorded->moment); !entered) return entered;
  }

  link::MatchPlayer player(std::move(*match));
  player.observe(std::make_shared<ProcessNews>());
  const IfExists ifExists = arguments.force ? IfExists::Replace : IfExists::Refuse;
  std::shared_ptr<TraceRows> trace;
  if (!arguments.trace.empty()) {
    auto made = TraceWriter::create(arguments.trace, ifExists, arguments.session,
                                    player.match().simulation().snapshot());
    if (!made) return cannotWrite(made.error(), arguments);
    trace = std::make_shared<TraceRows>(std::move(*made));
    player.observe(trace);
  }
  const Outcome outcome = Playing(player, *speed).play(trace.get());
  if (trace) {
    if (auto finished = trace->finish(); !finished) return finished;
  }
  if (!arguments.moment.empty()) {
    auto saved = writeFile(arguments.moment, link::scenarioToJson(player.match().toScenario()),
                           ifExists, arguments.session);
    if (!saved) return cannotWrite(saved.error(), arguments);
  }
  arguments.json ? printJson(player.match(), outcome) : printSummary(player.match(), outcome);
  return {};
}

void listScenarios() {
  for (const link::ScenarioName& scenario : link::builtInScenarios()) {
    std::printf("%-20s %s\n", scenario.name.c_str(), scenario.title.c_str());
  }
}

}  // namespace

void addSimulateCommand(CLI::App& parent, int& exitCode) {
  auto arguments = std::make_shared<Arguments>();
  Arguments& a = *arguments;
  CLI::App* command = parent.add_subcommand(
      "simulate",
      "plays a match and prints how it ended\n"
      "Examples: pitchboard-cli simulate --scenario match-3v3 --seed 7 --noise paper --json\n"
      "          pitchboard-cli simulate --scenario my.json --cognition external --speed 1\n"
      "          echo '{\"do\": \"create\", \"worlds\": 2}' | pitchboard-cli simulate --stdio");
  shared::addScenarioOptions(*command, a.match);
  CLI::Option* from =
      command
          ->add_option("--from", a.session,
                       "Go on from a recorded moment, exactly; the robots' processes start anew")
          ->type_name("FILE.mcap");
  CLI::Option* at = command->add_option("--at", a.at, "The moment, in seconds of the session")
                        ->type_name("S")
                        ->needs(from);
  from->needs(at);
  command
      ->add_option(
          "--duration", a.duration,
          "Simulated seconds; default: the scenario's stop conditions or the final whistle, "
          "else 60 (with --cognition none: until Ctrl+C)")
      ->type_name("S");
  command
      ->add_option("--speed", a.speed,
                   "Times real time, or max; default: max for inline cognition, else 1")
      ->type_name("X|max");
  command
      ->add_option("--cognition", a.cognition,
                   "inline: decision in this program; external: robot processes on System V "
                   "blackboards; none: blackboards for your own processes")
      ->type_name("inline|external|none")
      ->capture_default_str();
  std::string ruleSets;
  for (const link::RuleSetInfo& set : link::refereeRuleSets()) ruleSets += ", " + set.name;
  command
      ->add_option("--referee", a.rules,
                   "Rules of the match instead of the scenario's: " + ruleSets.substr(2) +
                       "; published is no referee")
      ->type_name("RULES");
  command
      ->add_option("--obey-referee", a.obeyReferee,
                   "Obey the GameController that is heard on this UDP port")
      ->type_name("PORT")
      ->check(CLI::Range(1, 65535));
  command->add_option("--trace", a.trace, "Write one CSV row per tick")->type_name("FILE.csv");
  command
      ->add_option("--save-moment", a.moment,
                   "Save the last moment as a scenario, to go on from or to draw")
      ->type_name("FILE.json");
  command->add_flag("--force", a.force, "Overwrite the trace or the moment if it exists");
  command->add_flag("--json", a.json, "Print the outcome as one JSON object");
  shared::addRobotsOptions(*command, a.robots);
  command
      ->add_option("--robot-program", a.robotProgram,
                   "Program of the external processes; default: pitchboard-robot beside this one")
      ->type_name("FILE");
  command->add_flag("--list", a.list, "Print the built-in scenarios");
  CLI::Option* stdio =
      command->add_flag("--stdio", a.stdio,
                        "Serve lines of JSON on standard input: worlds that another program steps, "
                        "reads and commands (docs/LEARNING.md)");
  for (const char* other : {"--scenario", "--seed", "--noise", "--physics"}) {
    from->excludes(command->get_option(other));
  }
  for (const char* other : {"--from", "--trace", "--save-moment", "--json", "--speed",
                            "--cognition", "--obey-referee", "--match", "--runtime"}) {
    stdio->excludes(command->get_option(other));
  }
  command->callback([arguments, &exitCode] {
    if (arguments->list) return listScenarios();
    if (arguments->stdio) {
      // As with processes of others, only the scenario's own conditions end a world.
      auto scenario = scenarioFrom(*arguments, link::Cognition::None, {});
      const auto served = scenario ? serveWorldLines(std::move(*scenario))
                                   : Result<void>(tl::unexpected(scenario.error()));
      if (!served) exitCode = reportError(served.error());
      return;
    }
    if (const auto done = simulate(*arguments); !done) exitCode = reportError(done.error());
  });
}

}  // namespace pitchboard::cli
