// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/conformance/conformance.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"

namespace pitchboard::cli {
namespace {

struct ConformanceOptions {
  std::vector<std::string> files;
  bool json = false;
};

void print(const std::string& file, const link::ConformanceReport& report, bool json) {
  if (json) {
    const nlohmann::ordered_json line{{"file", file},
                                      {"name", report.name},
                                      {"rows", report.rows},
                                      {"values", report.values},
                                      {"largest_deviation", report.largestDeviation},
                                      {"largest_where", report.largestWhere},
                                      {"differences", report.differences},
                                      {"first_difference", report.firstDifference},
                                      {"conforms", report.conforms()}};
    std::printf("%s\n", line.dump().c_str());
    return;
  }
  std::printf("%-6s %-36s %6d rows  largest deviation %.3g%s%s\n",
              report.conforms() ? "same" : "DIFFER", report.name.c_str(), report.rows,
              report.largestDeviation, report.largestWhere.empty() ? "" : " at ",
              report.largestWhere.c_str());
  if (!report.conforms()) {
    std::printf("       %lld values differ, the first: %s\n", report.differences,
                report.firstDifference.c_str());
  }
}

int checkTraces(const ConformanceOptions& options) {
  int exitCode = 0;
  for (const std::string& file : options.files) {
    const auto report = link::runConformance(file);
    if (!report) {
      exitCode = reportError(report.error());
      continue;
    }
    print(file, *report, options.json);
    if (!report->conforms() && exitCode == 0) exitCode = 1;
  }
  return exitCode;
}

}  // namespace

void addConformanceCommand(CLI::App& parent, int& exitCode) {
  auto options = std::make_shared<ConformanceOptions>();
  CLI::App* command = parent.add_subcommand(
      "conformance",
      "Compare the published model with recorded runs of the published simulator.\n"
      "Prints the largest deviation of each file; exits with 1 if any value differs.\n"
      "Example: pitchboard-cli conformance tests/data/traces/*.json");
  command->add_option("FILE", options->files, "Traces: FILE.json with FILE.csv.gz beside it")
      ->required();
  command->add_flag("--json", options->json, "One JSON object per file");
  command->callback([options, &exitCode] { exitCode = checkTraces(*options); });
}

}  // namespace pitchboard::cli
