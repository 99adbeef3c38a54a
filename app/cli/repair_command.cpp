// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/session/session_repair.h>

#include <cstdio>
#include <memory>

#include "commands.h"
#include "interrupt.h"
#include "progress.h"

namespace pitchboard::cli {
namespace {

struct Options {
  std::string from, to;
  bool progress = false;
};

int run(const Options& options) {
  const InterruptGuard signals;
  Result<telemetry::RepairReport> report;
  {
    Progress progress("repairing", options.progress);
    report = telemetry::repairSession(options.from, options.to,
                                      [&](double part) { return progress(part); });
  }
  if (!report) return reportError(report.error());
  for (const std::string& sentence : report->lost) std::fprintf(stderr, "%s\n", sentence.c_str());
  std::printf("%s: %s\n", options.to.c_str(), report->summary().c_str());
  return 0;
}

}  // namespace

void addRepairCommand(CLI::App& parent, int& exitCode) {
  auto options = std::make_shared<Options>();
  CLI::App* command = parent.add_subcommand(
      "repair",
      "Make a whole session of one that broke off or is damaged. The old file stays as it is.\n"
      "Example: pitchboard-cli repair match.mcap match-repaired.mcap");
  command->add_option("in", options->from, "The broken session")->required()->type_name("IN");
  command->add_option("out", options->to, "The new one; it must not exist")
      ->required()
      ->type_name("OUT");
  command->add_flag("--progress", options->progress,
                    "Say on stderr how far it is, also without a terminal");
  command->callback([options, &exitCode] { exitCode = run(*options); });
}

}  // namespace pitchboard::cli
