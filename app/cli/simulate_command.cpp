// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <memory>
#include <string>

#include <base/angles.h>
#include <base/byte_sizes.h>
#include <base/file_target.h>
#include <base/result.h>
#include <base/system_reason.h>
#include <base/time_text.h>
#include <base/try.h>
#include <robotlink/capi/world_lines.h>
#include <robotlink/session/match_recorder.h>
#include <robotlink/session/moment_reader.h>
#include <simcore/world/snapshot.h>
#include <telemetry/session/session_time.h>

#include "commands.h"
#include "interrupt.h"
#include "match_play.h"
#include "progress.h"
#include "simulate_report.h"
#include "what_if.h"

namespace pitchboard::cli {

/// Writes a simulated match as CSV: a row per tick, in metres, metres per second and degrees. The
/// file appears when it is complete. One thread at a time.
class TraceWriter {
 public:
  /// Writes the header for the robots of `first`. Fails as FileTarget does; `source` is the file
  /// that is read and must not be overwritten.
  static Result<TraceWriter> create(const std::string& path, IfExists ifExists,
                                    const std::string& source, const sim::Snapshot& first);

  /// Adds a row. Fails if the system cannot write, for example because the disk is full.
  Result<void> add(const sim::Snapshot& snapshot);
  /// Completes the file, flushes it to the disk and gives it its name.
  Result<void> finish();

 private:
  TraceWriter(FileTarget target, NewFile file)
      : m_target(std::move(target)), m_file(std::move(file)) {}
  Result<void> endLine();
  Result<void> flush();

  FileTarget m_target;
  NewFile m_file;
  std::string m_text;  ///< lines that are not written yet
  std::string m_line;
};

namespace {

template <class T>
void append(std::string& line, T value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
  if (!line.empty()) line += ',';
  line.append(text.data(), end.ptr);
}

constexpr std::size_t maxWaiting = 64 * kibibyte;  // bytes

}  // namespace

Result<TraceWriter> TraceWriter::create(const std::string& path, IfExists ifExists,
                                        const std::string& source, const sim::Snapshot& first) {
  auto target = TRY(FileTarget::at(path, ifExists, source));
  auto file = TRY(target.open());
  TraceWriter writer(std::move(target), std::move(file));
  writer.m_line = "tick,time_s,ball_x,ball_y,ball_vx,ball_vy,score_left,score_right";
  for (const sim::RobotSnapshot& robot : first.robots) {
    const std::string name = robot.identity.name() + '_';
    for (const char* column : {"x", "y", "heading_deg", "head_deg", "action"}) {
      writer.m_line += ',' + name + column;
    }
  }
  TRY(writer.endLine());
  return writer;
}

Result<void> TraceWriter::add(const sim::Snapshot& snapshot) {
  m_line.clear();
  append(m_line, snapshot.tick);
  append(m_line, snapshot.time);
  for (const double value :
       {snapshot.ball.x, snapshot.ball.y, snapshot.ballVelocity.x, snapshot.ballVelocity.y}) {
    append(m_line, value);
  }
  append(m_line, snapshot.score.left);
  append(m_line, snapshot.score.right);
  for (const sim::RobotSnapshot& robot : snapshot.robots) {
    append(m_line, robot.pose.position.x);
    append(m_line, robot.pose.position.y);
    append(m_line, degreesFromRadians(robot.pose.yaw));
    append(m_line, degreesFromRadians(robot.headYaw));
    append(m_line, robot.action);
  }
  return endLine();
}

Result<void> TraceWriter::endLine() {
  m_text += m_line;
  m_text += '\n';
  return m_text.size() < maxWaiting ? Result<void>{} : flush();
}

Result<void> TraceWriter::flush() {
  auto written = m_file.write(m_text);
  m_text.clear();
  return written;
}

Result<void> TraceWriter::finish() {
  TRY(flush());
  TRY(m_file.close());
  return m_target.commit();
}

namespace {

/// The next line, without its end; of one that is too long only the beginning, which is too long,
/// too. False at the end of the input.
bool nextLine(std::string& line) {
  line.clear();
  int byte = 0;
  while ((byte = std::getc(stdin)) != EOF && byte != '\n') {
    if (line.size() <= link::WorldLines::maxLineLength) line += static_cast<char>(byte);
  }
  return byte != EOF || !line.empty();
}

/// `simulate --stdio`: lines of JSON from standard input, an answer to each on standard output,
/// until the input ends. `usual`: what worlds are made of when a request names no scenario.
Result<void> serveWorldLines(link::Scenario usual) {
  link::WorldLines lines(std::move(usual));
  std::string line;
  while (nextLine(line)) {
    if (line.empty() || line == "\r") continue;
    const std::string answer = lines.answer(line) + '\n';
    if (std::fwrite(answer.data(), 1, answer.size(), stdout) != answer.size() ||
        std::fflush(stdout) != 0) {
      return failure(ErrorCode::SystemError, "cannot write an answer: " + systemReason(errno),
                     "standard output");
    }
  }
  return {};
}

struct Arguments {
  MatchPlayOptions play;
  std::string session;
  std::string at;
  bool clock = false;
  std::string trace;
  std::string moment;
  bool force = false;
  bool json = false;
  bool list = false;
  bool stdio = false;
  WhatIfOptions whatIf;
};

/// The moment of --at, in seconds of the session.
Result<double> momentIn(const telemetry::SessionReader& session, const Arguments& arguments) {
  const auto range = session.range();
  if (!range) {
    return failure(ErrorCode::NotFound, "The recording is empty.", arguments.session);
  }
  using telemetry::TimeForms;
  auto time = telemetry::sessionTime(arguments.at, session.info().start, *range,
                                     arguments.clock ? TimeForms::Clock : TimeForms::Session);
  if (!time) return failure(time.error().code, "--at: " + time.error().message);
  return time;
}

Result<RecordedStart> recordedMoment(const Arguments& arguments) {
  auto session = TRY(telemetry::SessionReader::open(arguments.session));
  const auto at = TRY(momentIn(session, arguments));
  return recordedStart(std::move(session), arguments.session, at);
}

Result<link::Scenario> scenarioFrom(const Arguments& arguments, link::Cognition cognition,
                                    const std::optional<RecordedStart>& recorded) {
  const MatchPlayOptions& play = arguments.play;
  auto scenario = scenarioToPlay(
      recorded ? shared::changed(recorded->scenario, play.match) : shared::scenarioFrom(play.match),
      play, cognition);
  if (!scenario || !recorded) return scenario;
  // Seconds from here on; a match that was already over continues, too.
  auto& duration = scenario->stop.duration;
  const double now = recorded->matchTime();
  if (play.duration) {
    duration = now + *play.duration;
  } else if (!duration && arguments.whatIf.runs > 0) {
    duration = now + defaultDuration;
  } else if (duration && *duration <= now + defaultDuration / 60.0) {
    duration = now + defaultDuration;
  }
  return scenario;
}

/// An old file is refused with the option that allows it.
tl::unexpected<Error> cannotWrite(Error error, const Arguments& arguments) {
  if (error.code == ErrorCode::Conflict && !isSameFile(error.context, arguments.session)) {
    error.message = "This file exists; add --force to replace it, or choose another name.";
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

/// Returns the exit code.
Result<int> simulate(const Arguments& arguments) {
  const auto cognition = shared::cognitionOf(arguments.play.robots);
  std::optional<RecordedStart> recorded;
  if (!arguments.session.empty()) {
    recorded = TRY(recordedMoment(arguments));
  }
  const auto scenario = TRY(scenarioFrom(arguments, cognition, recorded));
  const auto speed = TRY(speedOf(arguments.play, cognition, scenario));
  const InterruptGuard signals;
  Following following;
  if (recorded) following = TRY(followedBy(arguments.whatIf, *recorded, scenario));
  const auto start = [&](const link::Scenario& played) -> Result<link::SimulatedMatch> {
    auto match = TRY(createMatch(played, arguments.play, cognition));
    if (recorded && recorded->moment) {
      link::Moment moment = *recorded->moment;
      moment.state.settings.seed += played.settings.seed - scenario.settings.seed;
      TRY(match.restore(moment));
    }
    match.follow(following);
    return match;
  };
  if (arguments.whatIf.runs > 0) {
    TRY(playWhatIf(arguments.whatIf, *recorded, scenario, following,
                   [&](const link::Scenario& played,
                       const std::shared_ptr<link::TickObserver>& observer) -> Result<void> {
                     auto match = start(played);
                     if (!match) return tl::unexpected(match.error());
                     link::MatchPlayer player(std::move(*match));
                     player.observe(observer);
                     (void)playToEnd(player, speed, [] { return true; });
                     return {};
                   }));
    return 0;
  }

  link::MatchPlayer player(TRY(start(scenario)));
  const IfExists ifExists = arguments.force ? IfExists::Replace : IfExists::Refuse;
  std::shared_ptr<TraceRows> trace;
  if (!arguments.trace.empty()) {
    auto made = TraceWriter::create(arguments.trace, ifExists, arguments.session,
                                    player.match().simulation().snapshot());
    if (!made) return cannotWrite(made.error(), arguments);
    trace = std::make_shared<TraceRows>(std::move(*made));
    player.observe(trace);
  }
  Outcome outcome;
  {
    Progress progress("simulated", false);
    outcome = playToEnd(player, speed, [&] {
      const double rate = player.match().simulation().state().settings.tickRate;
      progress.show(secondsToText(static_cast<double>(player.currentTick()) / rate));
      return !trace || trace->written();
    });
  }
  if (trace) {
    TRY(trace->finish());
  }
  if (!arguments.moment.empty()) {
    auto saved = writeFile(arguments.moment, link::scenarioToJson(player.match().toScenario()),
                           ifExists, arguments.session);
    if (!saved) return cannotWrite(saved.error(), arguments);
  }
  if (recorded && !arguments.json) {
    for (const std::string& note : recorded->notes) std::printf("%s\n", note.c_str());
  }
  arguments.json ? printJson(player.match(), outcome) : printSummary(player.match(), outcome);
  return keepsDying(player.match()) ? 1 : 0;
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
      "Play a match and print how it ended. Exits with 1 if a robot's program kept dying.\n"
      "Examples: pitchboard-cli simulate --scenario match-3v3 --seed 7 --noise paper --json\n"
      "          pitchboard-cli simulate --scenario my.json --cognition separate --speed 1\n"
      "          echo '{\"do\": \"create\", \"worlds\": 2}' | pitchboard-cli simulate --stdio");
  addPlayOptions(*command, a.play);
  CLI::Option* from =
      command
          ->add_option("--from", a.session,
                       "Continue a recorded match exactly from --at; the robots' processes restart")
          ->type_name("FILE.mcap");
  CLI::Option* at =
      command
          ->add_option("--at", a.at,
                       std::string("Time in the recording: ") + telemetry::sessionTimeForms)
          ->type_name("T")
          ->needs(from);
  from->needs(at);
  command->add_flag("--clock", a.clock, "Read --at as a time of day (this computer's time zone)")
      ->needs(at);
  command
      ->add_option("--follow", a.whatIf.follow,
                   "Who follows the recording instead of playing: teams, robots, ball, such as "
                   "red,ball; until a robot that plays comes near (docs/tutorial-rerun.md)")
      ->type_name("WHO")
      ->delimiter(',')
      ->needs(from);
  command
      ->add_option("--reach", a.whatIf.reach,
                   "Followers are let go when a robot that plays is this near the ball or them, in "
                   "m, and elsewhere than recorded")
      ->type_name("M")
      ->check(CLI::Range(0.0, 20.0))
      ->capture_default_str()
      ->needs("--follow");
  command
      ->add_option("--runs", a.whatIf.runs,
                   "Play N matches with different seeds, each until a goal, and print how often "
                   "each outcome came, with 95 % intervals")
      ->type_name("N")
      ->check(CLI::Range(1, 100'000))
      ->needs(from);
  shared::addDuration(
      *command, "--duration", a.play.duration,
      "Stop after this simulated time; default: the scenario's end, the final whistle, or 60 s "
      "(with --cognition none: Ctrl+C)");
  command->add_option("--trace", a.trace, "Write a CSV file with one row per tick")
      ->type_name("FILE.csv");
  command->add_option("--save-moment", a.moment, "Save the last moment as a scenario file")
      ->type_name("FILE.json");
  addForce(*command, a.force, "Replace existing files");
  command->add_flag("--json", a.json, "Print the result as a JSON object");
  command->add_flag("--list", a.list, "List the built-in scenarios");
  CLI::Option* stdio = command->add_flag(
      "--stdio", a.stdio,
      "Let another program step worlds with lines of JSON on standard input (docs/worlds.md)");
  for (const char* other : {"--scenario", "--seed", "--noise", "--physics"}) {
    from->excludes(command->get_option(other));
  }
  for (const char* other :
       {"--from", "--trace", "--save-moment", "--json", "--speed", "--cognition", "--obey-referee",
        "--answer-referee", "--match", "--runtime"}) {
    stdio->excludes(command->get_option(other));
  }
  for (const char* other : {"--trace", "--save-moment"}) {
    command->get_option("--runs")->excludes(command->get_option(other));
  }
  addGroup(*command, "Continue a recording",
           {"--from", "--at", "--clock", "--follow", "--reach", "--runs"});
  addGroup(*command, "Other output", {"--trace", "--save-moment", "--force", "--stdio"});
  command->callback([arguments, &exitCode] {
    arguments->whatIf.json = arguments->json;
    if (arguments->list) return listScenarios();
    if (arguments->stdio) {
      // As with processes of others, only the scenario's own conditions end a world.
      auto scenario = scenarioFrom(*arguments, link::Cognition::None, {});
      const auto served = scenario ? serveWorldLines(std::move(*scenario))
                                   : Result<void>(tl::unexpected(scenario.error()));
      if (!served) exitCode = reportError(served.error());
      return;
    }
    const auto done = simulate(*arguments);
    exitCode = done ? *done : reportError(done.error());
  });
}

}  // namespace pitchboard::cli
