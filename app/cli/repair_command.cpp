// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/session/session_repair.h>

#include <cstdio>
#include <memory>

#include "commands.h"
#include "interrupt.h"
#include "progress.h"

namespace pitchboard::cli {
namespace {

struct RepairOptions {
  std::string from, to;
  bool force = false, progress = false;
};

int repairSession(const RepairOptions& options) {
  const auto old = ifExists(options.to, options.force, options.from);
  if (!old) return reportError(old.error());
  const InterruptGuard signals;
  Result<telemetry::RepairReport> report;
  {
    Progress progress("repairing", options.progress);
    report = telemetry::repairSession(
        options.from, options.to, [&](double part) { return progress(part); }, *old);
  }
  if (!report) return reportError(report.error());
  for (const std::string& note : report->notes) std::fprintf(stderr, "%s\n", note.c_str());
  std::printf("%s: %s\n", options.to.c_str(), report->summary().c_str());
  return report->complete ? 0 : 1;
}

}  // namespace

void addRepairCommand(CLI::App& parent, int& exitCode) {
  auto options = std::make_shared<RepairOptions>();
  CLI::App* command = parent.add_subcommand(
      "repair",
      "Recover a damaged recording into a new file. The old file is not changed.\nExits with 1 if "
      "data is missing, and prints what, with offset and time, to "
      "stderr.\nExample: pitchboard-cli repair match.mcap match-repaired.mcap");
  command->add_option("in", options->from, "The damaged recording")->required()->type_name("IN");
  command->add_option("out", options->to, "The new file")->required()->type_name("OUT");
  addForce(*command, options->force, "Replace the new file if it exists");
  command->add_flag("--progress", options->progress,
                    "Print progress to stderr even if it is not a terminal");
  command->callback([options, &exitCode] { exitCode = repairSession(*options); });
}

}  // namespace pitchboard::cli
