// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/experiment/tournament.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <base/csv_field.h>
#include <base/lined_json.h>
#include <robotlink/experiment/checks.h>
#include <telemetry/statistics/quantile.h>

#include "numbers.h"
#include "run_layout.h"
#include "tournament_parts.h"

namespace pitchboard::link {
namespace {

constexpr double maxStuckAllowed = 60.0;  // s

/// The two colours of the scenario's robots, in the order in which they first appear.
std::vector<TeamColor> coloursOf(const Json& scenario) {
  std::vector<TeamColor> out;
  for (const Json& robot : scenario.value("robots", Json::array())) {
    const Json team = robot.is_object() ? robot.value("team", Json()) : Json();
    if (!team.is_string()) continue;
    const auto known = teamColorNamed(team.get<std::string>());
    if (known && std::ranges::find(out, *known) == out.end()) out.push_back(*known);
  }
  return out;
}

std::vector<int> shirtsOf(const Json& scenario, TeamColor colour) {
  std::vector<int> out;
  for (const Json& robot : scenario.value("robots", Json::array())) {
    if (!robot.is_object() || robot.value("team", Json()) != std::string(info(colour).name))
      continue;
    const Json number = robot.value("number", Json(1));
    if (number.is_number_integer()) out.push_back(number.get<int>());
  }
  return out;
}

/// What the scenario has to be told so that the team plays in this colour.
bool addTeam(const TournamentTeam& team, TeamColor colour, const Json& scenario,
             std::vector<ScenarioSetting>& settings, JsonReport& report) {
  const std::string name(info(colour).name);
  if (!team.runtime.empty()) {
    settings.push_back({"runtime." + name, Json(team.runtime).dump(), team.line});
  }
  const std::vector<int> shirts = shirtsOf(scenario, colour);
  for (const auto& [shirt, setting] : team.robots) {
    if (shirt != 0 && std::ranges::find(shirts, shirt) == shirts.end()) {
      report.fail(setting.line, "team " + team.name,
                  "the scenario's " + name + " team has no robot " + std::to_string(shirt));
      return false;
    }
    for (const int one : shirts) {
      if (shirt != 0 && shirt != one) continue;
      const std::string robot = std::string(info(colour).letter) + std::to_string(one);
      settings.push_back({"robots[" + robot + "]." + setting.key, setting.value, setting.line});
    }
  }
  return true;
}

Json teamJson(const TournamentTeam& team, TeamColor colour) {
  Json out{{"colour", info(colour).name}, {"name", team.name}};
  if (team.number != 0) out["number"] = team.number;
  if (!team.advisor.empty()) out["advisor"] = Json::parse(team.advisor);
  return out;
}

std::string inColour(const TournamentTeam& team, TeamColor colour) {
  return team.name + " (" + std::string(info(colour).name) + ')';
}

/// The score of a team's match. `unit`: matches with the same one are drawn together.
struct Score {
  int goals = 0, against = 0;
  int coin = 0;  ///< 1: a coin decided the shoot-out for the team, -1: against it
  std::size_t unit = 0;
  int difference() const { return goals - against; }
  /// Above 0: won.
  int outcome() const { return difference() != 0 ? difference() : coin; }
};

class Scores {
 public:
  Scores(const Experiment& e, const ResultTable& results)
      : m_tournament(*e.tournament), m_results(results), m_runs(e.runs) {}

  /// Of the first of the pairing, or of the second.
  void add(std::size_t pairing, bool ofSecond, std::vector<Score>& out) const {
    const std::size_t sides = m_tournament.swapSides ? 2 : 1;
    for (std::size_t side = 0; side < sides; ++side) {
      const auto& rows = m_results.conditions[pairing * sides + side];
      for (std::size_t i = 0; i < rows.played.size(); ++i) {
        if (!rows.played[i]) continue;
        const auto& outcome = rows.outcomes[i];
        Score score{outcome.goals, outcome.goalsAgainst, outcome.coin, pairing * m_runs + i};
        if (ofSecond) score = {score.against, score.goals, -score.coin, score.unit};
        out.push_back(score);
      }
    }
  }

  /// Of a team, against everybody or one opponent.
  std::vector<Score> of(std::size_t team, std::optional<std::size_t> opponent) const {
    std::vector<Score> out;
    for (std::size_t p = 0; p < m_tournament.pairings.size(); ++p) {
      const auto [first, second] = m_tournament.pairings[p];
      if (first == team && second == opponent.value_or(second)) add(p, false, out);
      if (second == team && first == opponent.value_or(first)) add(p, true, out);
    }
    return out;
  }

 private:
  const Tournament& m_tournament;
  const ResultTable& m_results;
  std::size_t m_runs;
};

/// The mean of each unit.
std::vector<double> unitMeans(const std::vector<Score>& scores, const std::vector<double>& values) {
  std::map<std::size_t, SampleMoments> sums;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    SampleMoments& sum = sums[scores[i].unit];
    sum.mean += values[i];
    ++sum.count;
  }
  std::vector<double> out;
  for (const auto& [unit, sum] : sums) out.push_back(sum.mean / static_cast<double>(sum.count));
  return out;
}

MatchTotals totalsOf(const std::vector<Score>& scores) {
  MatchTotals out;
  std::vector<double> differences;
  for (const Score& score : scores) {
    out.won += score.outcome() > 0;
    out.wonByCoin += score.difference() == 0 && score.coin > 0;
    out.drawn += score.outcome() == 0;
    out.lost += score.outcome() < 0;
    out.goals += score.goals;
    out.goalsAgainst += score.against;
    differences.push_back(score.difference());
  }
  out.difference = momentsOf(differences).mean;
  out.difference95 = intervalOfMean(unitMeans(scores, differences));
  return out;
}

/// The values of tournamentMetrics(), in their order.
double scoreValue(const Score& score, std::size_t metric) {
  const int outcome = score.outcome();
  const double values[] = {
      static_cast<double>(score.difference()), static_cast<double>(score.goals),
      static_cast<double>(score.against),      outcome > 0 ? 3.0 : outcome == 0 ? 1.0 : 0.0,
      static_cast<double>(outcome > 0),        static_cast<double>(outcome == 0),
      static_cast<double>(outcome < 0)};
  return values[metric];
}

}  // namespace

void addMatches(Experiment& e, ConditionParts& parts, std::size_t matches, const JsonObject& root,
                JsonReport& report) {
  const Tournament& tournament = *e.tournament;
  const std::vector<TeamColor> colours = coloursOf(parts.scenario);
  if (colours.size() != 2) {
    return report.fail(
        1, "scenario",
        "has robots of " + std::to_string(colours.size()) + " teams; a match has two");
  }
  if (tournament.swapSides && matches % 2 != 0) {
    return root.fail("matches",
                     "is " + std::to_string(matches) +
                         ", but with swapped sides it must be even, so that both teams play as "
                         "often on either side");
  }
  const std::size_t sides = tournament.swapSides ? 2 : 1;
  e.team = colours[0];
  e.runs = matches / sides;
  e.commonSeeds = true;
  for (const Pairing& pairing : tournament.pairings) {
    for (std::size_t side = 0; side < sides; ++side) {
      const TournamentTeam& ours = tournament.teams[side == 0 ? pairing.first : pairing.second];
      const TournamentTeam& theirs = tournament.teams[side == 0 ? pairing.second : pairing.first];
      ConditionParts::Named condition{
          inColour(ours, colours[0]) + " against " + inColour(theirs, colours[1]),
          {},
          {},
          ours.line,
          colours[side]};
      condition.settings.push_back(
          {"teams", Json::array({teamJson(ours, colours[0]), teamJson(theirs, colours[1])}).dump(),
           ours.line});
      if (!addTeam(ours, colours[0], parts.scenario, condition.settings, report) ||
          !addTeam(theirs, colours[1], parts.scenario, condition.settings, report)) {
        return;
      }
      parts.named.push_back(std::move(condition));
    }
  }
}

void playToTheWhistle(Experiment& e, bool hasStop) {
  constexpr double halves = 6.0, pauses = 3600.0;  // with extra time; s of breaks and shoot-out
  double longest = 0.0;
  for (const Condition& condition : e.conditions) {
    const auto& referee = condition.scenario.settings.referee;
    if (hasStop || !referee || !referee->automatic) return;
    longest = std::max(longest, halves * referee->halfTime + pauses);
  }
  e.stop.duration = longest;
  e.tournament->wholeMatches = true;
}

Result<Experiment> tournamentExperiment(Tournament tournament, std::string_view scenario,
                                        std::size_t matches, Experiment how) {
  JsonReport report("tournament");
  const auto root = parseJson("{}", report);
  const auto whole = scenarioFromJson(scenario, "scenario");
  if (!whole) return tl::unexpected(whole.error());
  ConditionParts parts;
  parts.scenario = Json::parse(scenario);
  how.tournament = std::move(tournament);
  how.conditions.clear();
  const JsonObject object(report, *root, "");
  addMatches(how, parts, matches, object, report);
  makeWhole(how, parts, object, report);
  if (report.failed()) return tl::unexpected(report.error());
  playToTheWhistle(how, how.stop != RunStop{} || whole->stop.duration);
  return how;
}

TournamentTable tableOf(const Experiment& experiment, const ResultTable& results) {
  const Tournament& tournament = *experiment.tournament;
  const Scores scores(experiment, results);
  TournamentTable out;
  for (std::size_t t = 0; t < tournament.teams.size(); ++t) {
    out.teams.push_back({tournament.teams[t].name, totalsOf(scores.of(t, {}))});
  }
  std::ranges::stable_sort(out.teams, [](const auto& a, const auto& b) {
    const MatchTotals &x = a.totals, &y = b.totals;
    if (x.points() != y.points()) return x.points() > y.points();
    if (x.goals - x.goalsAgainst != y.goals - y.goalsAgainst) {
      return x.goals - x.goalsAgainst > y.goals - y.goalsAgainst;
    }
    return x.goals > y.goals;
  });
  for (const Pairing& pairing : tournament.pairings) {
    out.pairings.push_back({tournament.teams[pairing.first].name,
                            tournament.teams[pairing.second].name,
                            totalsOf(scores.of(pairing.first, pairing.second))});
  }
  for (std::size_t number = 1; number <= experiment.allRuns(); ++number) {
    const RunPlace place = placeOf(experiment, number);
    const auto& rows = results.conditions[place.condition];
    if (!rows.played[place.index]) continue;
    const auto value = [&](TeamValue which) {
      return rows.columns[static_cast<std::size_t>(which)][place.index];
    };
    if (tournament.wholeMatches && value(TeamValue::Timeout) != 0.0) {
      out.wrong.push_back({number, "no final whistle"});
    }
    if (const double count = value(TeamValue::IllegalTransitions); count > 0.0) {
      out.wrong.push_back({number, link::number(count) + " illegal state transitions"});
    }
    if (const double time = value(TeamValue::LongestStuck); time > maxStuckAllowed) {
      out.wrong.push_back(
          {number, "a robot was stuck for " + link::number(std::round(time)) + " s"});
    }
  }
  return out;
}

std::string tableCsv(const TournamentTable& table) {
  std::string out =
      "team,played,won,drawn,lost,goals,goals_against,goal_difference,goal_difference_low95,"
      "goal_difference_high95,points,won_by_coin\n";
  for (const auto& [name, totals] : table.teams) {
    out += csvField(name);
    for (const std::size_t count : {totals.played(), totals.won, totals.drawn, totals.lost}) {
      out += ',' + std::to_string(count);
    }
    out += ',' + std::to_string(totals.goals) + ',' + std::to_string(totals.goalsAgainst) + ',';
    if (std::isfinite(totals.difference)) out += shortest(totals.difference);
    const auto& range = totals.difference95;
    out += ',' + (range ? shortest(range->low) : "") + ',' + (range ? shortest(range->high) : "");
    out += ',' + std::to_string(totals.points()) + ',' + std::to_string(totals.wonByCoin) + '\n';
  }
  return out;
}

std::vector<MetricInfo> tournamentMetrics() {
  return {{"goal_difference", "", "Goal difference", false},
          {"goals", "", "Goals", false},
          {"goals_against", "", "Goals against", false},
          {"points", "", "Points", false},
          {"won", "", "Matches won", false},
          {"drawn", "", "Matches drawn", false},
          {"lost", "", "Matches lost", false}};
}

std::vector<CheckedAssertion> checkedAssertions(const Experiment& experiment,
                                                const ResultTable& results) {
  const std::vector<MetricInfo> metrics = tournamentMetrics();
  const auto& teams = experiment.tournament->teams;
  const Scores all(experiment, results);
  std::vector<CheckedAssertion> out;
  for (const TeamAssertion& one : experiment.tournament->assertions) {
    const std::vector<Score> scores = all.of(one.team, one.opponent);
    out.push_back(checkedBy(
        one.text,
        teams[one.team].name + (one.opponent ? " against " + teams[*one.opponent].name : ""),
        metrics, [&](std::size_t metric, bool ofUnits) {
          std::vector<double> values;
          for (const Score& score : scores) values.push_back(scoreValue(score, metric));
          return ofUnits ? unitMeans(scores, values) : values;
        }));
  }
  return out;
}

}  // namespace pitchboard::link
