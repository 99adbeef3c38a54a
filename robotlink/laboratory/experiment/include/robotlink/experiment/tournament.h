// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A tournament plays matches between teams, with sides swapped. It is an experiment: playRuns()
// plays it, ExperimentFolder keeps its results, and the table is computed from its runs. Plain
// values; any thread.

#include <string>
#include <string_view>
#include <vector>

#include <robotlink/experiment/experiment.h>
#include <robotlink/experiment/statistics.h>

namespace pitchboard::link {

struct ResultTable;

/// Returns the experiment that plays `matches` of each pairing in `scenario` (JSON). `how` gives
/// the other settings: seed, stop, speed, what is recorded. With swapped sides, `matches` must be
/// even; matches 2 k - 1 and 2 k of a pairing have the same seed. With the default `how.stop`,
/// whole matches are played if the scenario has an automatic referee. Errors name the team.
Result<Experiment> tournamentExperiment(Tournament tournament, std::string_view scenario,
                                        std::size_t matches, Experiment how = {});

/// The totals of a team's matches.
struct MatchTotals {
  std::size_t won = 0, drawn = 0, lost = 0;
  std::size_t wonByCoin = 0;  ///< of `won`: a coin decided the shoot-out
  int goals = 0, goalsAgainst = 0;
  /// Mean goal difference of a match, with its 95 % interval by the bootstrap, which draws the two
  /// matches with the same seed together. NaN without matches.
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
    MatchTotals totals;  ///< from the view of `first`
  };
  /// A match that makes the tournament invalid.
  struct WrongMatch {
    std::size_t number = 1;
    std::string what;  ///< "no final whistle"
  };
  std::vector<OfTeam> teams;  ///< the best first
  std::vector<OfPairing> pairings;
  std::vector<WrongMatch> wrong;
};

/// Makes the table from the matches that have been played.
TournamentTable tableOf(const Experiment& experiment, const ResultTable& results);
/// Returns the table as CSV, with a line for each team.
std::string tableCsv(const TournamentTable& table);

}  // namespace pitchboard::link
