// SPDX-License-Identifier: GPL-3.0-or-later
// pitchboard-agent: runs on the robot, and sends the variables of its blackboard or records
// them there (docs/agent.md).
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <base/try.h>
#include <robotlink/blackboard/system_v.h>
#include <robotlink/blackboard/variable_catalog.h>

#include "arguments.h"
#include "cycle_watch.h"
#include "output.h"
#include "recorder.h"
#include "schedule.h"

namespace pitchboard::agent {

/// The robot's blackboard, which the agent only reads. It is attached as soon as it exists, and
/// attached again if it was removed and created anew. One thread at a time.
class RobotSegment {
 public:
  RobotSegment(int key, const link::SegmentLayout& layout) : m_key(key), m_layout(layout) {}

  /// Looks for the segment, at most five times a second. Returns a message for the log after each
  /// change, otherwise an empty text.
  std::string look(std::chrono::microseconds now);

  bool isThere() const { return m_view.has_value(); }
  /// Reads the variables into `words`, which becomes empty if there is no blackboard. Each word is
  /// read atomically, but not all at the same instant.
  void read(std::span<const link::Variable> variables, std::vector<std::uint32_t>& words) const;

 private:
  int m_key;
  link::SegmentLayout m_layout;
  std::optional<link::SegmentView> m_view;
  std::optional<std::chrono::microseconds> m_looked;
  std::string m_reported;
};

std::string RobotSegment::look(std::chrono::microseconds now) {
  constexpr std::chrono::microseconds step = std::chrono::milliseconds(200);
  if (m_looked && now - *m_looked < step) return {};
  m_looked = now;
  if (m_view && m_view->isThere()) return {};
  auto view = link::SegmentView::attach(m_key, m_layout.bytes);
  const std::string name = "blackboard " + std::to_string(m_key);
  std::string text;
  const bool found = view.has_value();
  if (found) {
    text = m_view ? name + " was created again; reading the new one" : "reading " + name;
    m_view = *std::move(view);
  } else if (m_view && m_view->isShared()) {
    text = name + " was removed, but the robot's programs still use it; still reading it";
  } else {
    m_view.reset();
    text = view.error().code == ErrorCode::NotFound ? "waiting for " + name : view.error().text();
  }
  if (text == m_reported && !found) return {};
  return m_reported = std::move(text);
}

void RobotSegment::read(std::span<const link::Variable> variables,
                        std::vector<std::uint32_t>& words) const {
  words.clear();
  if (!m_view) return;
  for (const link::Variable& variable : variables) {
    const int offset = variable.type == link::VariableType::Float ? m_layout.floatOffset : 0;
    words.push_back(
        m_view->word(static_cast<std::size_t>(offset) + static_cast<std::size_t>(variable.index)));
  }
}

namespace {

using Clock = std::chrono::steady_clock;

Time now() {
  return std::chrono::duration_cast<Time>(Clock::now().time_since_epoch());
}

/// Takes the words of `chosen`, which are in the order of `all`.
void takeChosen(std::span<const link::Variable> all, const std::vector<std::uint32_t>& words,
                std::span<const link::Variable> chosen, std::vector<std::uint32_t>& out) {
  out.clear();
  if (words.empty()) return;
  for (std::size_t i = 0; i < all.size() && out.size() < chosen.size(); ++i) {
    if (all[i].name == chosen[out.size()].name) out.push_back(words[i]);
  }
}

/// For a person or the journal: nothing of it is read by programs.
void printLine(const std::string& text) {
  if (!text.empty()) std::fprintf(stderr, "pitchboard-agent: %s\n", text.c_str());
}

/// A signal asked for the end, so that a recording gets one.
std::atomic<bool> isAskedToEnd = false;

Result<std::vector<Output>> outputsOf(const Arguments& arguments) {
  std::vector<Output> outputs;
  for (const Receiver& receiver : arguments.receivers) {
    outputs.push_back(TRY(Output::to(
        receiver.address, receiver.port.value_or(telemetry::pb2PortBase + arguments.robot))));
  }
  return outputs;
}

/// Begins to record. A disk that fails is reported, and the robot is still watched.
Result<std::optional<Recorder>> recorderOf(const Arguments& arguments,
                                           const link::VariableCatalog& catalog,
                                           const link::SegmentLayout& layout) {
  if (arguments.record.empty()) return std::nullopt;
  RecordOptions options;
  options.path = arguments.record;
  options.robot = arguments.robot;
  options.key = arguments.boardKey();
  options.rate = arguments.readRate();
  options.fileBytes = static_cast<std::uint64_t>(arguments.recordSize * 1e6);
  options.keepBytes = static_cast<std::uint64_t>(arguments.recordKeep.value_or(0.0) * 1e6);
  auto recorder = Recorder::start(options, catalog, layout, now());
  if (!recorder) {
    const bool isMistake = recorder.error().code == ErrorCode::Conflict;
    if (isMistake || !arguments.sends) return tl::unexpected(recorder.error());
    printLine("cannot record: " + recorder.error().text());
    return std::nullopt;
  }
  std::signal(SIGXFSZ, SIG_IGN);
  for (const int number : {SIGINT, SIGTERM}) {
    std::signal(number, [](int) { isAskedToEnd = true; });
  }
  printLine("recording to " + recorder->path());
  return std::optional<Recorder>(*std::move(recorder));
}

Result<void> run(const Arguments& arguments) {
  link::SegmentLayout layout;
  const link::VariableCatalog map =
      arguments.catalog.empty() ? link::VariableCatalog::published()
      : arguments.catalog == extendedMap
          ? link::VariableCatalog::extended()
          : TRY(link::VariableCatalog::fromFile(arguments.catalog, layout));
  const link::VariableCatalog catalog = TRY(withCycles(map, layout, arguments.cycles));
  std::vector<link::Variable> chosen;
  if (arguments.sends) chosen = TRY(chosenVariables(map, arguments.globs));
  std::vector<Output> outputs = TRY(outputsOf(arguments));
  std::optional<Recorder> recorder = TRY(recorderOf(arguments, catalog, layout));
  const ScheduleOptions options{
      .robot = arguments.robot,
      .rate = arguments.rate,
      .bytesPerSecond = arguments.limit.value_or(0.0) * 1000.0 / 8.0,
      .receivers = static_cast<int>(outputs.size()),
  };
  Schedule schedule(options, chosen);
  RobotSegment segment(arguments.boardKey(), layout);
  if (arguments.sends) {
    std::string receivers;
    for (const Output& output : outputs) {
      receivers += (receivers.empty() ? "" : ", ") + output.name();
    }
    printLine("robot " + std::to_string(arguments.robot) + ": " + std::to_string(chosen.size()) +
              " variables to " + receivers);
  }

  const auto stepOf = [](double rate) { return Time(static_cast<Time::rep>(1e6 / rate)); };
  const Time step = stepOf(arguments.readRate()), sendStep = stepOf(arguments.rate);
  std::vector<std::uint32_t> words, sent;
  CycleWatch cycles(recorder ? catalog.variables() : std::span<const link::Variable>(),
                    arguments.boardKey());
  Time tick = now(), sendTick = tick;
  while (!isAskedToEnd) {
    const Time time = now();
    const std::string seen = segment.look(time);
    printLine(seen);
    segment.read(catalog.variables(), words);
    if (recorder) {
      if (!seen.empty()) recorder->note(time, seen);
      printLine(recorder->take(time, words));
      if (!recorder->isRecording() && !arguments.sends) {
        return failure(ErrorCode::SystemError, "nothing is recorded any more, and --to is none");
      }
    }
    if (!seen.empty()) cycles.attach();
    cycles.take(words);
    const bool isTick = time >= tick;  // otherwise a cycle was announced
    if (arguments.sends && isTick && tick >= sendTick) {
      sendTick = std::max(sendTick + sendStep, tick);
      takeChosen(catalog.variables(), words, chosen, sent);
      for (const std::string& datagram : schedule.next(time, sent)) {
        for (Output& output : outputs) printLine(output.send(datagram, time));
      }
    }
    // Ticks that were missed, because the computer slept or was busy, are left out.
    if (isTick) tick = std::max(tick + step, now());
    cycles.await(now(), tick);
  }
  return recorder ? recorder->finish() : Result<void>();
}

}  // namespace

}  // namespace pitchboard::agent

int main(int argc, char** argv) {
  using namespace pitchboard;
  constexpr int refused = 2;
  const auto arguments =
      agent::parseArguments(std::span<const char* const>(argv, static_cast<std::size_t>(argc))
                                .subspan(static_cast<std::size_t>(std::min(argc, 1))));
  if (!arguments) {
    std::fprintf(stderr, "error: %s\nRun with --help for the options and an example.\n",
                 arguments.error().text().c_str());
    return refused;
  }
  if (arguments->help || arguments->version) {
    std::fputs(arguments->help ? agent::helpText : PITCHBOARD_VERSION "\n", stdout);
    return 0;
  }
  const auto result = agent::run(*arguments);
  if (result) return 0;
  std::fprintf(stderr, "error: %s\n", result.error().text().c_str());
  return refused;
}
