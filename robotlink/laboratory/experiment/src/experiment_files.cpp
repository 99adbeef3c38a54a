// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment_files.h"

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include <base/csv_field.h>
#include <base/lined_json.h>

namespace pitchboard::link {
namespace {

using Json = nlohmann::ordered_json;

Json known(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json intervalJson(const std::optional<Interval>& interval) {
  if (!interval) return nullptr;
  return Json::array({known(interval->low), known(interval->high)});
}

Json summaryOfMetric(const Summary& s) {
  return {{"n", s.moments.count},
          {"mean", known(s.moments.mean)},
          {"mean_95", intervalJson(s.mean95)},
          {"sd", known(s.moments.deviation)},
          {"min", known(s.least)},
          {"p25", known(s.lowerQuartile)},
          {"median", known(s.median)},
          {"p75", known(s.upperQuartile)},
          {"p95", known(s.p95)},
          {"max", known(s.most)}};
}

Json welchJson(const std::optional<WelchTest>& test) {
  if (!test) return nullptr;
  return {{"difference", test->difference},
          {"difference_95", intervalJson(test->difference95)},
          {"t", test->t},
          {"df", test->freedom},
          {"p", test->p},
          {"t_critical_one_tailed", test->criticalOne},
          {"t_critical_two_tailed", test->criticalTwo},
          {"hedges_g", test->hedgesG}};
}

const char* testName(Comparison::Test test) {
  switch (test) {
    case Comparison::Test::Welch:
      return "welch";
    case Comparison::Test::Fisher:
      return "fisher";
    case Comparison::Test::None:
      break;
  }
  return nullptr;
}

/// Behind the members of `out`.
void addComparison(Json& out, const Comparison& one) {
  const char* const test = testName(one.test);
  out["difference"] = known(one.difference);
  out["difference_95"] = intervalJson(one.difference95);
  out["test"] = test ? Json(test) : Json(nullptr);
  out["p"] = test ? Json(one.p) : Json(nullptr);
  out["note"] = one.note;
  out["welch"] = welchJson(one.welch);
}

Json totalsJson(const MatchTotals& totals) {
  return {{"played", totals.played()},
          {"won", totals.won},
          {"won_by_coin", totals.wonByCoin},
          {"drawn", totals.drawn},
          {"lost", totals.lost},
          {"goals", totals.goals},
          {"goals_against", totals.goalsAgainst},
          {"goal_difference", known(totals.difference)},
          {"goal_difference_95", intervalJson(totals.difference95)},
          {"points", totals.points()}};
}

Json tournamentJson(const TournamentTable& table) {
  Json teams = Json::array(), pairs = Json::array(), wrong = Json::array();
  for (const auto& [name, totals] : table.teams) {
    teams.push_back({{"name", name}});
    teams.back().update(totalsJson(totals));
  }
  for (const auto& [first, second, totals] : table.pairings) {
    pairs.push_back({{"name", first}, {"opponent", second}});
    pairs.back().update(totalsJson(totals));
  }
  for (const auto& [number, what] : table.wrong) {
    wrong.push_back({{"run", number}, {"what", what}});
  }
  return {{"teams", std::move(teams)}, {"pairs", std::move(pairs)}, {"wrong", std::move(wrong)}};
}

/// ",RoboFEI,Red,2,1,1:0 1:1": the condition's team first.
std::string teamsOfLine(const Condition& condition, const MatchResult& match) {
  const bool second = match.teams[1].colour == condition.team;
  const TeamResult& ours = match.teams[second ? 1 : 0];
  const TeamResult& theirs = match.teams[second ? 0 : 1];
  std::string halves;
  for (std::size_t i = 0; i < std::min(ours.byHalf.size(), theirs.byHalf.size()); ++i) {
    halves += (i == 0 ? "" : " ") + std::to_string(ours.byHalf[i]) + ':' +
              std::to_string(theirs.byHalf[i]);
  }
  return ',' + csvField(titleOf(ours)) + ',' + csvField(titleOf(theirs)) + ',' +
         std::to_string(ours.score) + ',' + std::to_string(theirs.score) + ',' + halves;
}

}  // namespace

std::string csvHead(const std::vector<MetricInfo>& metrics) {
  std::string out =
      "run,condition,index,seed,ended_by,ticks,state_hash,repeatable,team,opponent,score,"
      "opponent_score,score_by_half";
  for (const MetricInfo& metric : metrics) out += ',' + metric.name;
  return out + '\n';
}

std::string csvLine(const Experiment& experiment, const RunResult& result) {
  const RunPlace place = placeOf(experiment, result.number);
  char hash[24];
  std::snprintf(hash, sizeof hash, "0x%016" PRIx64, result.hash);
  std::string out = std::to_string(result.number) + ',' +
                    csvField(experiment.conditions[place.condition].name) + ',' +
                    std::to_string(place.index + 1) + ',' + std::to_string(result.seed) + ',' +
                    result.match.endedBy + ',' + std::to_string(result.ticks) + ',' + hash + ',' +
                    (result.match.repeatable ? "1" : "0") +
                    teamsOfLine(experiment.conditions[place.condition], result.match);
  for (const double value : result.values) {
    out += ',';
    if (std::isfinite(value)) out += shortest(value);
  }
  return out + '\n';
}

std::string summaryJson(const Experiment& experiment, const ExperimentSummary& summary) {
  Json conditions = Json::array();
  for (const ConditionSummary& condition : summary.conditions) {
    Json metrics = Json::object();
    for (std::size_t m = 0; m < summary.metrics.size(); ++m) {
      if (condition.metrics[m].moments.count == 0) continue;
      metrics[summary.metrics[m].name] = summaryOfMetric(condition.metrics[m]);
    }
    Json ends = Json::object();
    for (const auto& [end, count] : condition.ends) ends[end] = count;
    conditions.push_back({{"name", condition.name},
                          {"runs", condition.runs},
                          {"not_repeatable", condition.unrepeatable},
                          {"ended_by", std::move(ends)},
                          {"metrics", std::move(metrics)}});
  }
  Json differences = Json::array();
  for (const ConditionDifference& one : summary.differences) {
    Json entry{{"metric", summary.metrics[one.metric].name},
               {"of", summary.conditions[one.second].name},
               {"minus", summary.conditions[one.first].name}};
    addComparison(entry, one.comparison);
    entry["paired_mean"] = known(one.paired.mean);
    entry["paired_mean_95"] = intervalJson(one.paired.mean95);
    entry["pairs"] = one.paired.pairs;
    differences.push_back(std::move(entry));
  }
  Json comparisons = Json::array();
  for (const GivenComparison& one : summary.comparisons) {
    Json entry{{"metric", summary.metrics[one.metric].name},
               {"of", summary.conditions[one.condition].name},
               {"minus", experiment.given[one.figure].name},
               {"mean", known(one.ours.mean)},
               {"sd", known(one.ours.deviation)},
               {"n", one.ours.count},
               {"given_mean", one.theirs.mean},
               {"given_sd", known(one.theirs.deviation)},
               {"given_n", one.theirs.count}};
    addComparison(entry, one.comparison);
    comparisons.push_back(std::move(entry));
  }
  Json assertions = Json::array();
  for (const CheckedAssertion& one : summary.assertions) {
    assertions.push_back({{"condition", one.condition},
                          {"check", one.text},
                          {"holds", one.holds},
                          {"values", one.values}});
  }
  Json out{{"experiment", experiment.name},
           {"title", experiment.title},
           {"runs_per_condition", experiment.runs},
           {"seed", experiment.seed},
           {"holds", summary.holds()},
           {"conditions", std::move(conditions)},
           {"differences", std::move(differences)},
           {"comparisons", std::move(comparisons)},
           {"assertions", std::move(assertions)}};
  if (summary.tournament) out["tournament"] = tournamentJson(*summary.tournament);
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace pitchboard::link
