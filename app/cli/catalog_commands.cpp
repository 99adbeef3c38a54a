// SPDX-License-Identifier: GPL-3.0-or-later
#include <cerrno>
#include <cstdio>
#include <iostream>
#include <memory>

#include <base/file_target.h>
#include <robotlink/blackboard/variable_catalog.h>

#include "commands.h"

namespace pitchboard::cli {
namespace {

struct ImportOptions {
  std::string file;
  std::string output;
  bool json = false;
};

std::string table(const link::VariableCatalog& catalog) {
  std::string text;
  int ints = 0;
  for (const link::Variable& variable : catalog.variables()) {
    const bool isInt = variable.type == link::VariableType::Int;
    ints += isInt ? 1 : 0;
    char line[32];
    std::snprintf(line, sizeof line, "%-5s %3d  ", isInt ? "int" : "float", variable.index);
    text += line + variable.name + "\n";
  }
  const auto floats = static_cast<int>(catalog.variables().size()) - ints;
  return text + std::to_string(ints) + " int and " + std::to_string(floats) + " float variables\n";
}

int importCatalog(const ImportOptions& options) {
  link::SegmentLayout layout;
  const auto catalog = link::VariableCatalog::fromFile(options.file, layout);
  if (!catalog) return reportError(catalog.error());
  const std::string text = options.json ? catalog->toJson(layout) : table(*catalog);
  if (options.output.empty()) {
    std::cout << text << std::flush;
    return 0;
  }
  if (const auto written = writeFile(options.output, text, IfExists::Replace, options.file);
      !written) {
    return reportError(written.error());
  }
  return 0;
}

}  // namespace

void addCatalogCommands(CLI::App& parent, int& exitCode) {
  auto* const group = parent.add_subcommand("catalog",
                                            "Import variable catalogs.\nExample: pitchboard-cli "
                                            "catalog import blackboard.h --json -o our-team.json");
  group->require_subcommand(1);
  const auto options = std::make_shared<ImportOptions>();
  auto* const command = group->add_subcommand(
      "import",
      "Read a team's variable catalog (blackboard.h, SharedMemory.py or JSON) and print "
      "it.\nExample: pitchboard-cli catalog import blackboard.h --json -o our-team.json");
  command->add_option("FILE", options->file, "The catalog: .h, .hpp, .py or .json")->required();
  command->add_flag("--json", options->json, "Print JSON that --catalog reads");
  command->add_option("-o,--output", options->output, "Write to this file")->type_name("FILE");
  command->callback([options, &exitCode] { exitCode = importCatalog(*options); });
}

}  // namespace pitchboard::cli
