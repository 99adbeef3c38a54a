// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <memory>

#include <app/option_arguments.h>
#include <app/scenario_options.h>
#include <base/file_target.h>
#include <base/read_file.h>
#include <base/try.h>

#include "commands.h"
#include "experiment_play.h"

namespace pitchboard::cli {
namespace {

struct TournamentOptions {
  std::string file, junit;
  PlayInto play;
  std::optional<std::uint64_t> seed;
  std::optional<std::size_t> matches;
  std::vector<std::string> advised;
};

Result<int> playTournament(const TournamentOptions& options) {
  const auto tournament =
      TRY(link::loadExperiment(options.file, {options.seed, {}, options.matches, options.advised}));
  if (!tournament.tournament) {
    return failure(ErrorCode::InvalidArgument,
                   "has no \"teams\", so it is no tournament; play it with pitchboard-cli "
                   "experiment",
                   options.file);
  }
  const int ended = TRY(playInto(tournament, options.play));
  const auto results = std::filesystem::path(options.play.folder) / "junit.xml";
  if (options.junit.empty() || !std::filesystem::exists(results)) return ended;
  constexpr std::size_t maxBytes = std::size_t{1} << 30;
  const auto text = TRY(readFile(results.string(), maxBytes, "the results"));
  TRY(writeFile(options.junit, text, IfExists::Replace));
  return ended;
}

}  // namespace

void addTournamentCommand(CLI::App& parent, int& exitCode) {
  auto options = std::make_shared<TournamentOptions>();
  TournamentOptions& o = *options;
  CLI::App* command = parent.add_subcommand(
      "tournament",
      "Play matches between teams, on all processors and with swapped sides, and print the table. "
      "Exits with 1 if an assertion fails or something goes wrong in a match.\n"
      "Examples: pitchboard-cli tournament ours-against-theirs.json --out results --matches 100\n"
      "          pitchboard-cli tournament league.json --out part2 --shard 2/8");
  command->add_option("tournament", o.file, "A JSON file (docs/experiments.md)")
      ->required()
      ->type_name("FILE");
  addPlayInto(*command, o.play);
  command->get_option("--out")->required();
  command
      ->add_option("--matches", o.matches,
                   "Matches of each pair of teams; default: the tournament's")
      ->type_name("N")
      ->check(CLI::Range(1, 1'000'000));
  command->add_option("--seed", o.seed, "Seed of the first match; default: the tournament's")
      ->check(shared::refuseNegative)
      ->type_name("N");
  command
      ->add_option("--advisor", o.advised,
                   "Let the keeper of the team of this name learn where the opponents aim "
                   "(docs/advisor.md); may be repeated")
      ->type_name("TEAM");
  command->add_option("--junit", o.junit, "Also write the results as JUnit XML to this file")
      ->type_name("FILE.xml");
  whenChosen(*command, options, exitCode, playTournament);
}

}  // namespace pitchboard::cli
