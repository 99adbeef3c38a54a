// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cstdio>
#include <exception>

#include "commands.h"

int main(int argc, char** argv) try {
  using namespace pitchboard::cli;
  CLI::App app{
      "Pitchboard on the command line: simulate matches, listen to robots, read blackboards, "
      "record and export.\n"
      "Examples: pitchboard-cli simulate --scenario match-3v3 --duration 60\n"
      "          pitchboard-cli record --live -o training.mcap\n"
      "          pitchboard-cli export training.mcap --to csv-wide -o training.csv"};
  app.name("pitchboard-cli");
  app.require_subcommand(1);
  app.set_version_flag("--version", PITCHBOARD_VERSION, "Print the version");

  int exitCode = 0;
  constexpr std::array commands{
      &addSimulateCommand,   &addConformanceCommand, &addBlackboardCommands, &addCatalogCommands,
      &addListenCommand,     &addDecodeCommand,      &addRecordCommand,      &addInspectCommand,
      &addRepairCommand,     &addExportCommand,      &addImportCommand,      &addJoinCommand,
      &addExperimentCommand, &addTournamentCommand,  &addTestCommand,        &addCalibrateCommand,
      &addLearnCommand,      &addExploreCommand,     &addRerunCommand,       &addServeCommand,
      &addFindCommand,       &addCheckCommand,       &addStatisticsCommand};
  for (const AddCommand add : commands) add(app, exitCode);

  if (const auto ended = pitchboard::shared::parse(app, argc, argv)) exitCode = *ended;
  return pitchboard::shared::checkOutput(exitCode);
} catch (const std::exception& error) {
  std::fprintf(stderr, "error: %s\n", error.what());
  return pitchboard::shared::exitRefused;
}
