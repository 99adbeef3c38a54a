// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <functional>
#include <memory>

#include <base/try.h>
#include <robotlink/session/join_recording.h>

#include "commands.h"
#include "interrupt.h"
#include "progress.h"

namespace pitchboard::cli {
namespace {

struct JoinCommand {
  std::string session, recording, output;
  link::JoinOptions options;
  std::optional<double> drift_ppm;
  bool force = false, progress = false;
};

Result<int> join(const JoinCommand& command) {
  link::JoinOptions options = command.options;
  if (command.drift_ppm) options.drift = *command.drift_ppm * 1e-6;
  options.replace =
      TRY(ifExists(command.output, command.force, command.session)) == IfExists::Replace;
  const InterruptGuard signals;
  const auto report = [&] {
    Progress progress("joining", command.progress);
    return link::joinRecording(command.session, command.recording, command.output, options,
                               std::ref(progress));
  }();
  if (!report) {
    Error error = report.error();
    if (error.code == ErrorCode::NotFound && error.context.empty()) {
      error.context = "--robot, --offset";
    }
    return tl::unexpected(std::move(error));
  }
  for (const std::string& note : report->notes) std::fprintf(stderr, "%s\n", note.c_str());
  std::printf("%s: %s\n", command.output.c_str(), report->summary().c_str());
  return 0;
}

}  // namespace

void addJoinCommand(CLI::App& parent, int& exitCode) {
  auto options = std::make_shared<JoinCommand>();
  CLI::App* command = parent.add_subcommand(
      "join",
      "Join a robot's own recording to a live session.\n"
      "What pitchboard-agent --record wrote on the robot replaces the values of its blackboard "
      "that "
      "were received, or is added beside its messages. The clocks are matched by the changes that "
      "both contain; the result is printed.\n"
      "Example: pitchboard-cli join match.mcap robot3.mcap -o joined.mcap");
  command->add_option("session", options->session, "The live session")
      ->required()
      ->type_name("SESSION");
  command
      ->add_option("recording", options->recording,
                   "The robot's own recording; of several files that belong together, any one")
      ->required()
      ->type_name("RECORDING");
  command->add_option("-o,--output", options->output, "The joined session")
      ->required()
      ->type_name("FILE.mcap");
  command
      ->add_option("--robot", options->options.robot,
                   "Name of the robot in the session; default: the one with the recording's number")
      ->type_name("NAME");
  CLI::Option* offset =
      command
          ->add_option("--offset", options->options.offset,
                       "Time of the session minus time of the recording, in s, instead of the "
                       "estimated one")
          ->type_name("S");
  command
      ->add_option("--drift", options->drift_ppm,
                   "How much faster the session's clock runs, in ppm; default: 0")
      ->type_name("PPM")
      ->needs(offset);
  addForce(*command, options->force, "Replace the output if it exists");
  command->add_flag("--progress", options->progress,
                    "Print progress to stderr even if it is not a terminal");
  whenChosen(*command, options, exitCode, join);
}

}  // namespace pitchboard::cli
