// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include <base/time_text.h>
#include <base/try.h>
#include <robotlink/blackboard/match_number.h>
#include <robotlink/rerun/program_watch.h>
#include <robotlink/rerun/rerun_check.h>
#include <robotlink/rerun/rerun_text.h>
#include <telemetry/session/session_time.h>

#include "commands.h"
#include "interrupt.h"
#include "progress.h"

namespace pitchboard::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto watchInterval = 50ms;

struct RerunCommand {
  std::string session;  // the first of `sessions`
  std::vector<std::string> sessions;
  std::string from, until, speed = "max", out, check, junit, report;
  std::vector<std::string> processes;
  std::optional<double> warmUp, slack;
  link::RerunOptions options;
  bool same = false, ignoreSame = false, json = false, force = false, progress = false;
  bool watch = false;
};

Result<std::vector<link::RerunProcess>> processesOf(const RerunCommand& command) {
  std::vector<link::RerunProcess> processes;
  for (const std::string& text : command.processes) {
    link::RerunProcess& process = processes.emplace_back(TRY(link::rerunProcessFromText(text)));
    process.program = link::besideRecording(process.program, command.session);
  }
  return processes;
}

Result<link::RerunOptions> rerunOptions(const RerunCommand& command,
                                        const telemetry::SessionReader& session) {
  link::RerunOptions options = command.options;
  options.processes = TRY(processesOf(command));
  const auto range = session.range().value_or(telemetry::TimeRange{});
  const auto time = [&](const std::string& text, std::optional<double>& seconds) -> Result<void> {
    if (!text.empty()) seconds = TRY(telemetry::sessionTime(text, session.info().start, range));
    return {};
  };
  TRY(time(command.from, options.from));
  TRY(time(command.until, options.until));
  options.speed = TRY(shared::speedFrom(command.speed));
  options.warmUp = command.warmUp;
  options.slack = command.slack;
  options.isUnchanged = command.same;
  return options;
}

/// What an earlier --same found, if there is such a file beside the session.
Result<void> takeUnchanged(const RerunCommand& command, link::RerunOptions& options) {
  if (command.same || command.ignoreSame) return {};
  options.unchanged = TRY(link::readUnchanged(command.session, options));
  return {};
}

/// Prints the assertions. Returns the exit code.
Result<int> judge(const RerunCommand& command, const link::RerunCheck& check,
                  const link::RerunResult& result) {
  auto checked = TRY(check.judge(result));
  int exitCode = 0;
  for (const link::CheckedAssertion& one : checked) {
    if (!one.holds) exitCode = 1;
    std::fprintf(command.json ? stderr : stdout, "%s  %s (%s)\n", one.holds ? "holds " : "FAILED",
                 one.text.c_str(), one.values.c_str());
  }
  if (!command.junit.empty()) {
    TRY(writeFile(command.junit, link::rerunJunit(check.name(), std::move(checked)),
                  IfExists::Replace));
  }
  return exitCode;
}

struct RerunEnd {
  int exitCode = 0;
  std::shared_ptr<const link::RerunOutputs> outputs;
};

/// Runs one recording, and compares also with the outputs of the last run, if there are any.
Result<RerunEnd> rerunSession(const RerunCommand& command,
                              std::shared_ptr<const link::RerunOutputs> last) {
  const IfExists old = TRY(ifExists(command.out, command.force, command.session));
  const IfExists oldReport = TRY(ifExists(command.report, command.force, command.session));
  std::optional<link::RerunCheck> check;
  if (!command.check.empty()) check = TRY(link::RerunCheck::fromFile(command.check));
  const auto session = TRY(telemetry::SessionReader::open(command.session));
  link::RerunOptions options = TRY(rerunOptions(command, session));
  TRY(takeUnchanged(command, options));
  options.last = std::move(last);
  std::optional<Progress> progress;
  progress.emplace("rerunning", command.progress);
  options.progress = [&](double part) { return (*progress)(part) && !interrupted; };
  options.note = [&](const std::string& sentence) {
    std::fprintf(stderr, "%s%s\n", progress->fresh().c_str(), sentence.c_str());
  };
  options.print = options.note;
  if (check) {
    options.compared = [&](double time, auto variables, auto values) {
      check->add(time, variables, values);
    };
  }
  const auto result =
      TRY(command.out.empty() ? link::rerun(session, options)
                              : link::rerunToFile(session, options, command.out, old));
  progress.reset();
  const std::string text = command.json ? link::rerunToJson(result, command.session) + '\n'
                                        : link::rerunTable(result) + link::sinceLastTable(result);
  std::fputs(text.c_str(), stdout);
  if (!command.report.empty()) {
    TRY(writeFile(command.report, link::rerunReport(result, command.session), oldReport));
  }
  if (command.same) {
    const auto path = TRY(link::keepUnchanged(command.session, options, result));
    std::fprintf(stderr,
                 result.stretches() > 0 ? "Later reruns leave these differences out: %s\n"
                                        : "Later reruns know that nothing differs: %s\n",
                 path.c_str());
  }
  return RerunEnd{check ? TRY(judge(command, *check, result)) : 0, result.outputs};
}

Result<int> rerunOnce(const RerunCommand& command) {
  const InterruptGuard signals;
  return TRY(rerunSession(command, nullptr)).exitCode;
}

/// Runs again whenever the program's files change, until somebody interrupts it. A program that
/// fails is reported and the next change awaited; the exit code is that of the last complete run.
Result<int> rerunWatching(RerunCommand command) {
  if (command.same) {
    return failure(ErrorCode::InvalidArgument,
                   "--same runs the unchanged program once; leave --watch out.");
  }
  const std::vector<link::RerunProcess> processes = TRY(processesOf(command));
  const InterruptGuard signals;
  link::ProgramWatch watch(processes);
  {
    const auto session = TRY(telemetry::SessionReader::open(command.session));
    const auto options = TRY(rerunOptions(command, session));
    TRY(link::planRerun(session, options));
  }
  if (watch.isEmpty()) {
    return failure(ErrorCode::InvalidArgument,
                   "There is no file to watch, because the processes are ours; name a program, for "
                   "example decision=./decide.py.",
                   "--watch");
  }
  RerunEnd end;
  for (bool first = true; !interrupted; first = false) {
    const auto ran = rerunSession(command, end.outputs);
    if (interrupted) break;
    // What never could run is a mistake in the command; a program that breaks may be mended.
    if (!ran && first && ran.error().code != ErrorCode::SystemError) {
      return tl::unexpected(ran.error());
    }
    if (ran) end = *ran;
    if (!ran) (void)reportError(ran.error());
    std::fflush(stdout);
    std::fprintf(stderr, "Waiting for a change of the program; Ctrl+C ends.\n");
    while (!interrupted && !watch.hasChanged(std::chrono::steady_clock::now())) {
      std::this_thread::sleep_for(watchInterval);
    }
    if (interrupted) break;
    std::fprintf(stderr, "%s has changed.\n", watch.changedFile().c_str());
    command.force = true;  // its own files of the last run
  }
  return end.exitCode;
}

/// A recording of many.
struct RerunOfMany {
  std::optional<Result<link::RerunResult>> result;
  std::vector<std::string> notes;
};

Result<link::RerunResult> rerunOne(RerunCommand command, const std::string& path,
                                   std::vector<std::string>& notes) {
  command.session = path;
  const auto session = TRY(telemetry::SessionReader::open(path));
  link::RerunOptions options = TRY(rerunOptions(command, session));
  TRY(takeUnchanged(command, options));
  options.progress = [](double) { return !interrupted; };
  options.note = [&notes](const std::string& sentence) { notes.push_back(sentence); };
  return link::rerun(session, options);
}

/// The row of a recording: values, differences, and the first of them.
std::string manyRow(const std::string& path, const link::RerunResult& result, std::size_t width) {
  const link::ComparedVariable* first = nullptr;
  for (const link::ComparedVariable& one : result.variables) {
    if (!one.differs()) continue;
    if (!first || one.stretches.front().begin < first->stretches.front().begin) first = &one;
  }
  char numbers[64];
  std::snprintf(numbers, sizeof numbers, "%10llu  %11llu  ",
                static_cast<unsigned long long>(result.compared()),
                static_cast<unsigned long long>(result.stretches()));
  std::string text = padded(path, width) + numbers;
  if (!first) return text + "–";
  return text + secondsToText(first->stretches.front().begin) + ' ' + first->column.name + ' ' +
         link::differenceText(*first, first->stretches.front()) +
         (result.isTooCoarse() ? " (the recording may be the reason)" : "");
}

/// Recordings run at the same time, one per processor. Those that fail are named; the others run
/// anyway.
Result<int> rerunMany(const RerunCommand& command) {
  if (!command.out.empty() || !command.report.empty() || !command.check.empty() || command.same ||
      command.watch) {
    return failure(ErrorCode::InvalidArgument,
                   "--out, --report, --check, --same and --watch take one recording; leave them "
                   "out, or name one.");
  }
  const InterruptGuard signals;
  std::vector<RerunOfMany> all(command.sessions.size());
  {
    Progress progress("rerunning", command.progress);
    std::atomic<std::size_t> next = 0, done = 0;
    const auto work = [&] {
      for (std::size_t i = next++; i < all.size(); i = next++) {
        all[i].result = rerunOne(command, command.sessions[i], all[i].notes);
        ++done;
      }
    };
    std::vector<std::jthread> threads;
    const std::size_t jobs =
        std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, all.size());
    for (std::size_t i = 0; i < jobs; ++i) threads.emplace_back(work);
    while (done < all.size()) {
      (void)progress(static_cast<double>(done) / static_cast<double>(all.size()));
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }
  if (interrupted) return failure(ErrorCode::Conflict, "Cancelled.");
  std::size_t width = std::string("Recording").size();
  for (const std::string& path : command.sessions) width = std::max(width, path.size());
  if (!command.json) {
    std::printf("%s      Values  Differences  First\n", padded("Recording", width).c_str());
  }
  int exitCode = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string& path = command.sessions[i];
    for (const std::string& note : all[i].notes) {
      std::fprintf(stderr, "%s: %s\n", path.c_str(), note.c_str());
    }
    const Result<link::RerunResult>& result = *all[i].result;
    if (!result) {
      Error error = result.error();
      if (error.text().find(path) == std::string::npos) error.message = path + ": " + error.message;
      exitCode = reportError(error);
    } else if (command.json) {
      std::printf("%s\n", link::rerunToJson(*result, path).c_str());
    } else {
      std::printf("%s\n", manyRow(path, *result, width).c_str());
    }
  }
  return exitCode;
}

}  // namespace

void addRerunCommand(CLI::App& parent, int& exitCode) {
  auto options = std::make_shared<RerunCommand>();
  RerunCommand& o = *options;
  CLI::App* command = parent.add_subcommand(
      "rerun",
      "Run a recording through a process again and compare its outputs with the recorded ones. "
      "With --check it exits with 1 if an assertion fails.\n"
      "Examples: pitchboard-cli rerun match.mcap --robot B1 --process decision=reference\n"
      "          pitchboard-cli rerun match.mcap --robot B1 --process decision=./decide.py --from "
      "5:00 --out rerun.mcap");
  command
      ->add_option("session", o.sessions,
                   "The recording; several run at the same time, with a line each")
      ->required()
      ->type_name("SESSION");
  command->add_option("--robot", o.options.robot, "The robot whose process runs again: B1")
      ->required()
      ->type_name("NAME");
  command
      ->add_option("--process", o.processes,
                   "What runs: PROCESS=reference (ours), decision=BEHAVIOUR, PROCESS=PROGRAM "
                   "with its arguments or a runtime profile, or a runtime profile alone "
                   "(team.json) for all of its processes; may be repeated")
      ->required()
      ->type_name("PROCESS=PROGRAM")
      ->allow_extra_args(false);
  command->add_option("--from", o.from, "Compare from this time on")->type_name("T");
  command->add_option("--until", o.until, "Compare until this time")->type_name("T");
  command
      ->add_option("--warm-up", o.warmUp,
                   "Seconds before --from that are played and not compared; default: everything "
                   "in lock-step, otherwise 10")
      ->type_name("S")
      ->check(CLI::Range(0.0, 1e9));
  command->add_option("--speed", o.speed, "Speed relative to real time, 0.01 to 1000, or max")
      ->type_name("X|max")
      ->capture_default_str();
  command
      ->add_option("--out", o.out,
                   "Write a recording with the robot \"B1 rerun\" beside the original")
      ->type_name("FILE.mcap");
  command->add_option("--report", o.report, "Write the differences as an HTML page")
      ->type_name("FILE.html");
  command
      ->add_option("--check", o.check, "Assertions over the new outputs (docs/tutorial-rerun.md)")
      ->type_name("FILE.json");
  command->add_option("--junit", o.junit, "Write the assertions as JUnit XML")
      ->type_name("FILE.xml")
      ->needs(command->get_option("--check"));
  command->add_flag("--same", o.same,
                    "Run the unchanged program: what differs now is left out of later reruns");
  command->add_flag("--watch", o.watch,
                    "Run again whenever the program's file, or a .py file beside it, changes, and "
                    "compare with the last run, too; Ctrl+C ends");
  command->add_flag("--ignore-same", o.ignoreSame, "Compare also what --same found");
  addForce(*command, o.force, "Replace existing files");
  command->add_flag("--json", o.json, "Print the result as a JSON object, one for each recording");
  command->add_flag("--exact", o.options.exact,
                    "Count every distance, not only those beyond the tolerance of the unit");
  command
      ->add_option("--slack", o.slack,
                   "Seconds by which the program may act earlier or later; default: 0 in "
                   "lock-step, otherwise 0.5")
      ->type_name("S")
      ->check(CLI::Range(0.0, 60.0));
  command
      ->add_option("--writes", o.options.writes,
                   "More variables that the process writes; * stands for any text")
      ->type_name("NAMES")
      ->allow_extra_args(false);
  command
      ->add_option("--catalog", o.options.catalog,
                   "Map of variables (.json, .h, .py); default: that of the recording")
      ->type_name("FILE");
  command
      ->add_option("--match", o.options.match,
                   "Number of the match whose blackboard keys a program gets; default: the next "
                   "free one")
      ->type_name("N")
      ->check(CLI::Range(0, link::MatchNumber::most));
  command
      ->add_option("--robot-program", o.options.robotProgram,
                   "Program that keeps separate programs; default: pitchboard-robot beside this "
                   "program")
      ->type_name("FILE");
  command->add_flag("--progress", o.progress,
                    "Print progress to stderr even if it is not a terminal");
  addGroup(*command, "Comparing", {"--exact", "--slack", "--ignore-same"});
  addGroup(*command, "Programs", {"--writes", "--catalog", "--match", "--robot-program"});
  whenChosen(*command, options, exitCode, [](RerunCommand& chosen) {
    chosen.session = chosen.sessions.front();
    if (chosen.sessions.size() > 1) return rerunMany(chosen);
    return chosen.watch ? rerunWatching(chosen) : rerunOnce(chosen);
  });
}

}  // namespace pitchboard::cli
