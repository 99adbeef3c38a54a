// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Tournaments: n matches between given teams, sides swapped, as an experiment that playRuns() plays
// and ExperimentFolder keeps; the table of results is made from its runs. Plain values; any thread.

#include <string>
#include <string_view>
#include <vector>

#include <robotlink/experiment/experiment.h>
#include <robotlink/experiment/statistics.h>

namespace pitchboard::link {

struct ResultTable;

/// An experiment that plays the tournament in `scenario` (JSON), `matches` of each pairing. `how`
/// has the rest: seed, stop, speed, what is recorded. With swapped sides `matches` is even, and the
/// matches 2 k - 1 and 2 k of a pairing have the same seed. A `how.stop` as by default plays whole
/// matches where the scenario has an automatic referee. Errors name the team.
Result<Experiment> tournamentExperiment(Tournament tournament, std::string_view scenario,
                                        std::size_t matches, Experiment how = {});

/// The sum of a team's matches.
struct MatchTotals {
  std::size_t won = 0, drawn = 0, lost = 0;
  int goals = 0, goalsAgainst = 0;
  /// A match's goal difference: the mean, and its 95 % interval by the bootstrap, which draws the
  /// two matches with one seed together. NaN without matches.
  double difference = 0.0;
  std::optional<Interval> difference95;
  std::size_t played() const { return won + drawn + lost; }
  std::size_t points() const { return 3 * won + drawn; }
};

struct TournamentTable {
  struct OfTeam {
    std::string name;
    MatchTotals totals;
  };
  struct OfPairing {
    std::string first, second;
    MatchTotals totals;  ///< of the first
  };
  /// A match in which something went wrong that no tournament may have.
  struct WrongMatch {
    std::size_t number = 1;
    std::string what;  ///< "no final whistle"
  };
  std::vector<OfTeam> teams;  ///< the best first
  std::vector<OfPairing> pairings;
  std::vector<WrongMatch> wrong;
};

/// Of the matches that were played.
TournamentTable tableOf(const Experiment& experiment, const ResultTable& results);
/// A line for each team.
std::string tableCsv(const TournamentTable& table);

}  // namespace pitchboard::link
