// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <thread>

#include <base/read_file.h>
#include <base/time_text.h>
#include <base/try.h>
#include <robotlink/blackboard/match_number.h>
#include <robotlink/rerun/rerun_check.h>
#include <robotlink/rerun/rerun_text.h>
#include <telemetry/session/session_time.h>

#include "commands.h"
#include "interrupt.h"
#include "progress.h"

namespace pitchboard::cli {
namespace {

constexpr std::size_t maxUnchangedBytes = std::size_t{64} << 20;

struct RerunCommand {
  std::string session;  // the first of `sessions`
  std::vector<std::string> sessions;
  std::string from, until, speed = "max", out, check, junit, report;
  std::vector<std::string> processes;
  std::optional<double> warmUp, slack;
  link::RerunOptions options;
  bool same = false, ignoreSame = false, json = false, force = false, progress = false;
};

Result<link::RerunOptions> rerunOptions(const RerunCommand& command,
                                        const telemetry::SessionReader& session) {
  link::RerunOptions options = command.options;
  for (const std::string& process : command.processes) {
    options.processes.push_back(TRY(link::rerunProcessFromText(process)));
  }
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
  return options;
}

/// What an earlier --same found, if there is such a file beside the session.
Result<void> takeUnchanged(const RerunCommand& command, link::RerunOptions& options) {
  const std::string path = link::unchangedPath(command.session, options);
  std::error_code code;
  if (command.same || command.ignoreSame || !std::filesystem::exists(path, code)) return {};
  const std::string text = TRY(readFile(path, maxUnchangedBytes));
  options.unchanged = TRY(link::unchangedFromJson(text, path)).variables;
  return {};
}

/// `--same` keeps what it found; an older result of it is replaced.
Result<void> keepUnchanged(const RerunCommand& command, const link::RerunOptions& options,
                           const link::RerunResult& result) {
  const std::string path = link::unchangedPath(command.session, options);
  TRY(writeFile(path, link::rerunToJson(result, command.session) + '\n', IfExists::Replace));
  std::fprintf(stderr, "Later reruns leave these differences out: %s\n", path.c_str());
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

Result<int> rerunSession(const RerunCommand& command) {
  const IfExists old = TRY(ifExists(command.out, command.force, command.session));
  const IfExists oldReport = TRY(ifExists(command.report, command.force, command.session));
  std::optional<link::RerunCheck> check;
  if (!command.check.empty()) check = TRY(link::RerunCheck::fromFile(command.check));
  const auto session = TRY(telemetry::SessionReader::open(command.session));
  link::RerunOptions options = TRY(rerunOptions(command, session));
  TRY(takeUnchanged(command, options));
  const InterruptGuard signals;
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
  const std::string text =
      command.json ? link::rerunToJson(result, command.session) + '\n' : link::rerunTable(result);
  std::fputs(text.c_str(), stdout);
  if (!command.report.empty()) {
    TRY(writeFile(command.report, link::rerunReport(result, command.session), oldReport));
  }
  if (command.same) {
    options.robot = result.robot;
    TRY(keepUnchanged(command, options, result));
  }
  return check ? TRY(judge(command, *check, result)) : 0;
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
  if (!command.out.empty() || !command.report.empty() || !command.check.empty() || command.same) {
    return failure(ErrorCode::InvalidArgument,
                   "--out, --report, --check and --same take one recording; leave them out, or "
                   "name one.");
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
                   "What runs: PROCESS=reference (ours), decision=BEHAVIOUR, or PROCESS=PROGRAM "
                   "with its arguments or a runtime profile; may be repeated")
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
    return chosen.sessions.size() == 1 ? rerunSession(chosen) : rerunMany(chosen);
  });
}

}  // namespace pitchboard::cli
