// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/import/import_session.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>

#include <base/try.h>

#include "commands.h"
#include "interrupt.h"
#include "progress.h"

namespace pitchboard::cli {
namespace {

struct ImportCommand {
  std::vector<std::string> files;
  std::string output, mapping, clock = "auto", align;
  bool printMap = false, force = false, progress = false;
};

Result<link::ImportOptions> importOptions(const ImportCommand& command) {
  link::ImportOptions options;
  options.program = programName;
  options.clock = command.clock == "header" ? link::RecordingClock::Header
                  : command.clock == "log"  ? link::RecordingClock::Log
                                            : link::RecordingClock::Auto;
  const auto event = std::ranges::find(link::alignEventNames, command.align);
  if (event != link::alignEventNames.end()) {
    options.align = static_cast<link::AlignEvent>(event - link::alignEventNames.begin());
  }
  if (!command.mapping.empty()) options.mapping = TRY(link::mappingFromFile(command.mapping));
  return options;
}

/// Prints the mapping that is used without --map, to be saved and changed.
Result<int> printMapping(const ImportCommand& command) {
  const auto readers = TRY(telemetry::openRecordings(command.files));
  std::vector<telemetry::RecordedTopic> topics;
  for (const auto& reader : readers) {
    topics.insert(topics.end(), reader->topics().begin(), reader->topics().end());
  }
  const std::string text = link::mappingText(link::builtInMapping(topics));
  std::fwrite(text.data(), 1, text.size(), stdout);
  return 0;
}

Result<int> importFiles(const ImportCommand& command) {
  if (command.printMap) return printMapping(command);
  if (command.output.empty()) {
    return failure(ErrorCode::InvalidArgument,
                   "Name the new session: add -o SESSION.mcap, or --print-map to see the mapping.");
  }
  auto options = TRY(importOptions(command));
  options.ifExists = TRY(ifExists(command.output, command.force, command.files.front()));
  const InterruptGuard signals;
  const auto report = [&] {
    Progress progress("importing", command.progress);
    return link::importRecordings(command.files, command.output, options, std::ref(progress));
  }();
  if (!report) return tl::unexpected(report.error());
  for (const std::string& note : report->notes) std::fprintf(stderr, "note: %s\n", note.c_str());
  std::printf("%s: %s\n", command.output.c_str(), report->summary().c_str());
  return 0;
}

}  // namespace

void addImportCommand(CLI::App& parent, int& exitCode) {
  auto options = std::make_shared<ImportCommand>();
  CLI::App* command = parent.add_subcommand(
      "import",
      "Make a session of what other programs recorded. It reads MCAP (ROS 2, ROS 1, JSON, "
      "protobuf), rosbag2 (sqlite3), CSV, and the GameController's log. A folder or several files "
      "are one recording; with --align each is a recording of its own.\n"
      "What cannot be read is printed to stderr with its count.\n"
      "Examples: pitchboard-cli import rosbag2_2026_07_01/ -o match.mcap\n"
      "          pitchboard-cli import robot.mcap --map team.json -o match.mcap\n"
      "          pitchboard-cli import robot.mcap --print-map > team.json\n"
      "          pitchboard-cli import log.yaml robot3/ robot4/ --align kick-off -o match.mcap");
  command->add_option("FILE", options->files, "The recordings")->required();
  command->add_option("-o,--output", options->output, "The new session")->type_name("SESSION");
  command
      ->add_option(
          "--map", options->mapping,
          "File that says which topics are robots, ball, battery, referee and log; without "
          "it the usual messages of ROS are known")
      ->type_name("FILE");
  command
      ->add_option(
          "--time", options->clock,
          "Which time of a message counts: header (when it was measured), log (when it was "
          "recorded), or auto (header, unless the clocks differ by more than a minute)")
      ->check(CLI::IsMember({"auto", "header", "log"}))
      ->capture_default_str();
  command
      ->add_option(
          "--align", options->align,
          "Move recordings of one match, whatever their clocks say, so that an event is at "
          "the same time in all: kick-off (PLAYING begins), or set (SET before it, if "
          "robots are told of the kick-off later than the referee's log has it)")
      ->type_name("EVENT")
      ->check(CLI::IsMember(
          std::vector<std::string>(link::alignEventNames.begin(), link::alignEventNames.end())));
  command->add_flag("--print-map", options->printMap,
                    "Print the mapping that is used without --map, and import nothing");
  addForce(*command, options->force, "Replace the session if it exists");
  command->add_flag("--progress", options->progress,
                    "Print progress to stderr even if it is not a terminal");
  whenChosen(*command, options, exitCode, importFiles);
}

}  // namespace pitchboard::cli
