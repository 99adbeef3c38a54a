// SPDX-License-Identifier: GPL-3.0-or-later
// pitchboard-agent: runs on the robot and sends the variables of its blackboard (docs/agent.md).
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <span>
#include <thread>
#include <vector>

#include <base/try.h>

#include "arguments.h"
#include "output.h"
#include "robot_segment.h"
#include "schedule.h"

namespace pitchboard::agent {
namespace {

using Clock = std::chrono::steady_clock;

Time now() {
  return std::chrono::duration_cast<Time>(Clock::now().time_since_epoch());
}

/// For a person or the journal: nothing of it is read by programs.
void printLine(const std::string& text) {
  if (!text.empty()) std::fprintf(stderr, "pitchboard-agent: %s\n", text.c_str());
}

Result<void> run(const Arguments& arguments) {
  link::SegmentLayout layout;
  const link::VariableCatalog catalog =
      arguments.catalog.empty() ? link::VariableCatalog::published()
                                : TRY(link::VariableCatalog::fromFile(arguments.catalog, layout));
  const auto variables = TRY(chosenVariables(catalog, arguments.globs));
  std::vector<Output> outputs;
  std::string receivers;
  for (const Receiver& receiver : arguments.receivers) {
    outputs.push_back(TRY(Output::to(
        receiver.address, receiver.port.value_or(telemetry::pb2PortBase + arguments.robot))));
    receivers += (receivers.empty() ? "" : ", ") + outputs.back().name();
  }
  const ScheduleOptions options{
      .robot = arguments.robot,
      .rate = arguments.rate,
      .bytesPerSecond = arguments.limit.value_or(0.0) * 1000.0 / 8.0,
      .receivers = static_cast<int>(outputs.size()),
  };
  Schedule schedule(options, variables);
  RobotSegment segment(arguments.key.value_or(100 * arguments.robot), layout);
  printLine("robot " + std::to_string(arguments.robot) + ": " + std::to_string(variables.size()) +
            " variables to " + receivers);

  const Time step(static_cast<Time::rep>(1e6 / arguments.rate));
  std::vector<std::uint32_t> words;
  for (Time tick = now();;) {
    const Time time = now();
    printLine(segment.look(time));
    segment.read(schedule.variables(), words);
    for (const std::string& datagram : schedule.next(time, words)) {
      for (Output& output : outputs) printLine(output.send(datagram, time));
    }
    // Ticks that were missed, because the computer slept or was busy, are left out.
    tick = std::max(tick + step, now());
    std::this_thread::sleep_until(Clock::time_point(tick));
  }
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
  std::fprintf(stderr, "error: %s\n", result.error().text().c_str());
  return refused;
}
