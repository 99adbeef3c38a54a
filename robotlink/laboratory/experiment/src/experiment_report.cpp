// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>

#include <robotlink/report/field_svg.h>
#include <robotlink/report/report_page.h>
#include <telemetry/statistics/histogram.h>

#include "experiment_files.h"
#include "numbers.h"

namespace pitchboard::link {
namespace {

constexpr std::size_t maxDistributions = 8;
constexpr std::size_t bins = 24;

/// A table of the report: both forms are made from it.
struct Table {
  std::string title, note;
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
  std::size_t leftColumns = 1;
};

const char* const figureColours[] = {"#2f6fc6", "#c96f16", "#3f8a5e", "#5f4bb6", "#c2413c"};

std::string conditionText(const Experiment& e) {
  return std::to_string(e.runs) + (e.runs == 1 ? " run" : " runs") + " in each of " +
         std::to_string(e.conditions.size()) +
         (e.conditions.size() == 1 ? " condition" : " conditions") + ", seeds from " +
         std::to_string(e.seed) +
         (e.commonSeeds && e.conditions.size() > 1
              ? "; the same seeds in every condition (common random numbers)."
              : ".") +
         (e.hasTeamPrograms() ? " A team's own programs play: at most " + number(e.speed) +
                                    " times as fast as real time, slower when they cannot keep up."
                              : "");
}

Table endsTable(const ExperimentSummary& s) {
  Table table{"How the runs ended", "", {"Condition", "Runs"}, {}, 1};
  std::vector<std::string> ends;
  for (const ConditionSummary& condition : s.conditions) {
    for (const auto& [end, count] : condition.ends) {
      if (std::ranges::find(ends, end) == ends.end()) ends.push_back(end);
    }
  }
  for (const std::string& end : ends) table.head.push_back(endText(end));
  const bool some = std::ranges::any_of(
      s.conditions, [](const ConditionSummary& one) { return one.unrepeatable > 0; });
  if (some) {
    table.head.emplace_back("Not repeatable");
    table.note =
        "A run is not repeatable if the match did not wait for a team's program, if a program did "
        "not finish a cycle in time, or if the run ended differently when it was played again.";
  }
  for (const ConditionSummary& condition : s.conditions) {
    std::vector<std::string> row{condition.name, std::to_string(condition.runs)};
    for (const std::string& end : ends) {
      const auto found = condition.ends.find(end);
      row.push_back(std::to_string(found == condition.ends.end() ? 0 : found->second));
    }
    if (some) row.push_back(std::to_string(condition.unrepeatable));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table metricsTable(const ExperimentSummary& s, const std::vector<std::size_t>& metrics) {
  Table table{"Measured",
              "Mean with its 95 % interval (of rates Clopper and Pearson's, of others the "
              "bootstrap's), standard deviation, quantiles.",
              {"Metric", "Condition", "n", "Mean", "95 % of the mean", "SD", "Median", "25 %",
               "75 %", "95 %"},
              {},
              2};
  for (const std::size_t m : metrics) {
    for (const ConditionSummary& condition : s.conditions) {
      const Summary& one = condition.metrics[m];
      const MetricInfo& metric = s.metrics[m];
      const auto value = [&](double v) { return metric.rate ? std::string("–") : number(v); };
      table.rows.push_back({titleOf(metric), condition.name, std::to_string(one.moments.count),
                            valueText(metric, one.moments.mean), intervalText(metric, one.mean95),
                            value(one.moments.deviation), value(one.median),
                            value(one.lowerQuartile), value(one.upperQuartile), value(one.p95)});
    }
  }
  return table;
}

/// Difference, 95 %, test, p, t, df, g.
std::vector<std::string> comparisonCells(const MetricInfo& metric, const Comparison& one) {
  std::vector<std::string> cells(7, "–");
  cells[0] = valueText(metric, one.difference);
  if (one.difference95) cells[1] = intervalText(metric, *one.difference95);
  cells[2] = one.testText();
  if (one.test != Comparison::Test::None) cells[3] = probabilityText(one.p);
  if (one.welch) {
    cells[4] = fixed(one.welch->t, 2);
    cells[5] = fixed(one.welch->freedom, 1);
    cells[6] = fixed(one.welch->hedgesG, 2);
  }
  return cells;
}

constexpr const char* testsNote =
    "Two-sided: Fisher's exact test for rates, Welch's t-test for means; g is Hedges' effect size. "
    "Without spread there is no test.";

Table differencesTable(const Experiment& e, const ExperimentSummary& s,
                       const std::vector<std::size_t>& metrics) {
  Table table{"Differences between conditions",
              "Each condition minus the first. " + std::string(testsNote),
              {"Metric", "Condition", "Difference", "95 %", "Test", "p", "t", "df", "g"},
              {},
              2};
  if (e.commonSeeds) {
    table.note += " The last column uses that run i has the same seed in both.";
    table.head.push_back("Mean of pairs, 95 %");
  }
  for (const ConditionDifference& one : s.differences) {
    if (std::ranges::find(metrics, one.metric) == metrics.end()) continue;
    const MetricInfo& metric = s.metrics[one.metric];
    std::vector<std::string> row{
        titleOf(metric), s.conditions[one.second].name + " − " + s.conditions[one.first].name};
    std::ranges::move(comparisonCells(metric, one.comparison), std::back_inserter(row));
    if (e.commonSeeds) {
      row.push_back(valueText(metric, one.paired.mean) + ' ' +
                    intervalText(metric, one.paired.mean95));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table comparisonsTable(const Experiment& e, const ExperimentSummary& s) {
  Table table{"Comparison with given figures",
              "This experiment minus the given figure. " + std::string(testsNote),
              {"Metric", "Condition", "Given by", "Ours", "Given", "Difference", "95 %", "Test",
               "p", "t", "df", "g", "Critical t, one-tailed", "two-tailed"},
              {},
              3};
  for (const GivenComparison& one : s.comparisons) {
    const MetricInfo& metric = s.metrics[one.metric];
    const auto sample = [&metric](const SampleMoments& moments) {
      return valueText(metric, moments.mean) +
             (metric.rate ? std::string() : " ± " + number(moments.deviation)) +
             " (n = " + std::to_string(moments.count) + ')';
    };
    std::vector<std::string> row{titleOf(metric), s.conditions[one.condition].name,
                                 e.given[one.figure].name, sample(one.ours), sample(one.theirs)};
    std::ranges::move(comparisonCells(metric, one.comparison), std::back_inserter(row));
    const auto& welch = one.comparison.welch;
    row.push_back(welch ? fixed(welch->criticalOne, 2) : "–");
    row.push_back(welch ? fixed(welch->criticalTwo, 2) : "–");
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table assertionsTable(const ExperimentSummary& s) {
  Table table{"Assertions", "", {"Condition", "Assertion", "Measured", "Holds"}, {}, 3};
  for (const CheckedAssertion& one : s.assertions) {
    table.rows.push_back({one.condition, one.text, one.values, one.holds ? "yes" : "NO"});
  }
  return table;
}

std::vector<std::string> totalsCells(const MatchTotals& totals) {
  const auto& range = totals.difference95;
  return {std::to_string(totals.played()),
          std::to_string(totals.won) +
              (totals.wonByCoin > 0 ? " (" + std::to_string(totals.wonByCoin) + " by coin)" : ""),
          std::to_string(totals.drawn),
          std::to_string(totals.lost),
          std::to_string(totals.goals) + " : " + std::to_string(totals.goalsAgainst),
          number(totals.difference),
          range ? '[' + number(range->low) + ", " + number(range->high) + ']' : "–",
          std::to_string(totals.points())};
}

constexpr std::array totalsHead{"Played", "Won",        "Drawn", "Lost",
                                "Goals",  "Difference", "95 %",  "Points"};

Table teamsTable(const ExperimentSummary& s) {
  Table table{"Table",
              "Difference: goals of a match minus goals against, the mean and its 95 % interval by "
              "the bootstrap; the two matches that have one seed and swapped sides are drawn "
              "together. Three points for a match won, one for a draw.",
              {"Team"},
              {},
              1};
  table.head.insert(table.head.end(), totalsHead.begin(), totalsHead.end());
  for (const auto& [name, totals] :
       s.tournament ? s.tournament->teams : std::vector<TournamentTable::OfTeam>{}) {
    std::vector<std::string> row{name};
    std::ranges::move(totalsCells(totals), std::back_inserter(row));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// With two teams the table says it.
Table pairingsTable(const ExperimentSummary& s) {
  Table table{"Results of each pairing", "", {"Team", "Against"}, {}, 2};
  table.head.insert(table.head.end(), totalsHead.begin(), totalsHead.end());
  if (!s.tournament || s.tournament->pairings.size() < 2) return table;
  for (const auto& [first, second, totals] : s.tournament->pairings) {
    std::vector<std::string> row{first, second};
    std::ranges::move(totalsCells(totals), std::back_inserter(row));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table wrongTable(const ExperimentSummary& s) {
  Table table{"Matches with problems", "", {"Run", "What"}, {}, 2};
  for (const auto& [number, what] :
       s.tournament ? s.tournament->wrong : std::vector<TournamentTable::WrongMatch>{}) {
    table.rows.push_back({std::to_string(number), what});
  }
  return table;
}

std::vector<Table> tablesOf(const Experiment& e, const ExperimentSummary& s) {
  const std::vector<std::size_t> metrics = informativeMetrics(s);
  std::vector<Table> all{teamsTable(s),           pairingsTable(s),       wrongTable(s),
                         assertionsTable(s),      comparisonsTable(e, s), endsTable(s),
                         metricsTable(s, metrics)};
  // Of a tournament, conditions are matches of different teams.
  if (!s.tournament) all.push_back(differencesTable(e, s, metrics));
  std::erase_if(all, [](const Table& table) { return table.rows.empty(); });
  return all;
}

std::string markdownCell(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

std::string tableHtml(const Table& table) {
  const auto kind = [&table](std::size_t column) {
    return column < table.leftColumns ? std::string(" class=\"l\"") : std::string();
  };
  std::string out = "<h2>" + escaped(table.title) + "</h2>\n";
  if (!table.note.empty()) out += "<p class=\"quiet\">" + escaped(table.note) + "</p>\n";
  out += "<div class=\"scroll\"><table><thead><tr>";
  for (std::size_t c = 0; c < table.head.size(); ++c) {
    out += "<th" + kind(c) + '>' + escaped(table.head[c]) + "</th>";
  }
  out += "</tr></thead><tbody>\n";
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c) {
      const bool bad = row[c] == "NO";
      out += (bad ? "<td class=\"low\"" : "<td" + kind(c)) + ">" + escaped(row[c]) + "</td>";
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

/// Ways of the drawn runs of a condition: robots in the colour of how the run ended, the ball over
/// them.
std::string pathsHtml(const Experiment& e, const ResultTable::OfCondition& runs, std::size_t index,
                      const std::string& name) {
  if (runs.drawn.empty()) return {};
  std::vector<FieldTrajectory> trajectories;
  for (const auto& run : runs.drawn) {
    const bool goal = run.endedBy == "goal";
    for (const RunPath& path : run.paths) {
      if (path.who == "ball") continue;
      trajectories.push_back({path.points, goal ? "#7fb4ff" : "#ff9d8a", 0.55, 0.02});
    }
  }
  for (const auto& run : runs.drawn) {
    for (const RunPath& path : run.paths) {
      if (path.who == "ball") trajectories.push_back({path.points, "#f0a35e", 0.6, 0.015});
    }
  }
  return "<figure>" + fieldSvg(e.conditions[index].scenario.settings.field, trajectories) +
         "<figcaption>" + escaped(name) + ": paths of the first " +
         std::to_string(runs.drawn.size()) +
         " runs; blue: robots of runs that ended with a goal, red: of the others, orange: the "
         "ball.</figcaption></figure>\n";
}

std::string distributionHtml(const ResultTable& table, const ExperimentSummary& s, std::size_t m) {
  double low = INFINITY, high = -INFINITY;
  for (const ConditionSummary& condition : s.conditions) {
    if (condition.metrics[m].moments.count == 0) continue;
    low = std::min(low, condition.metrics[m].least);
    high = std::max(high, condition.metrics[m].most);
  }
  if (!(high > low)) return {};
  constexpr double width = 440, height = 130, left = 8, foot = 108, top = 10;
  const auto at = [](double value) { return fixed(value, 1); };
  std::string bars;
  const std::size_t shown = std::min(s.conditions.size(), std::size(figureColours));
  for (std::size_t c = 0; c < shown; ++c) {
    const auto counts = telemetry::histogram(table.conditions[c].columns[m], low, high, bins);
    const double all = std::max<double>(1.0, static_cast<double>(s.conditions[c].runs));
    std::string line;
    const double step = (width - 2 * left) / static_cast<double>(bins);
    for (std::size_t b = 0; b < bins; ++b) {
      const double y = foot - (foot - top) * std::sqrt(static_cast<double>(counts[b]) / all);
      line += at(left + step * static_cast<double>(b)) + ',' + at(y) + ' ' +
              at(left + step * static_cast<double>(b + 1)) + ',' + at(y) + ' ';
    }
    bars += "<polyline points=\"" + at(left) + ',' + at(foot) + ' ' + line + at(width - left) +
            ',' + at(foot) + "\" fill=\"" + figureColours[c] +
            "\" fill-opacity=\"0.15\" stroke=\"" + figureColours[c] + "\" stroke-width=\"1.5\"/>";
  }
  const auto text = [&](double x, const char* anchor, const std::string& label) {
    return "<text class=\"axis\" x=\"" + at(x) + "\" y=\"" + at(height - 6) + "\" text-anchor=\"" +
           anchor + "\">" + label + "</text>";
  };
  return "<div><h3><span>" + escaped(titleOf(s.metrics[m])) +
         "</span></h3><svg class=\"chart\" viewBox=\"0 0 " + at(width) + ' ' + at(height) +
         "\"><line class=\"grid\" x1=\"" + at(left) + "\" y1=\"" + at(foot) + "\" x2=\"" +
         at(width - left) + "\" y2=\"" + at(foot) + "\"/>" + bars +
         text(left, "start", number(low)) + text(width - left, "end", number(high)) +
         "</svg></div>\n";
}

std::string distributionsHtml(const ResultTable& table, const ExperimentSummary& s) {
  std::string charts;
  std::size_t count = 0;
  for (const std::size_t m : informativeMetrics(s)) {
    if (s.metrics[m].rate || count >= maxDistributions) continue;
    const std::string chart = distributionHtml(table, s, m);
    count += !chart.empty();
    charts += chart;
  }
  if (charts.empty()) return {};
  std::string legend;
  for (std::size_t c = 0; c < std::min(s.conditions.size(), std::size(figureColours)); ++c) {
    legend += " <span style=\"color:" + std::string(figureColours[c]) + "\">■</span> " +
              escaped(s.conditions[c].name);
  }
  return "<h2>Distributions</h2>\n<p class=\"quiet\">Share of the runs, drawn as its square root "
         "so "
         "that rare ones are seen." +
         legend + "</p>\n<div class=\"charts\">" + charts + "</div>\n";
}

}  // namespace

std::string reportMarkdown(const Experiment& e, const ExperimentSummary& s) {
  std::string out = "# " + markdownCell(e.title.empty() ? e.name : e.title) + "\n\n";
  if (!e.description.empty()) out += e.description + "\n\n";
  out += conditionText(e) + "\n";
  for (const std::string& text : identicalTexts(s)) out += "\n**" + markdownCell(text) + "**\n";
  for (const Table& table : tablesOf(e, s)) {
    out += "\n## " + table.title + "\n\n" + (table.note.empty() ? "" : table.note + "\n\n") + '|';
    for (const std::string& head : table.head) out += ' ' + head + " |";
    out += "\n|";
    for (std::size_t c = 0; c < table.head.size(); ++c) {
      out += c < table.leftColumns ? "---|" : "---:|";
    }
    for (const auto& row : table.rows) {
      out += "\n|";
      for (const std::string& cell : row) out += ' ' + markdownCell(cell) + " |";
    }
    out += '\n';
  }
  return out;
}

std::string experimentReportHtml(const Experiment& e, const ResultTable& results,
                                 const ExperimentSummary& s) {
  const std::string title = escaped(e.title.empty() ? e.name : e.title);
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"><title>" +
      title + "</title><style>" + std::string(reportStyle) +
      "figure svg { display: block; width: 100%; height: auto; }\n"
      ".fields { display: grid; grid-template-columns: repeat(auto-fit, minmax(420px, 1fr)); gap: "
      "16px; }\n</style></head><body><main>\n<h1>" +
      title + "</h1>\n";
  if (!e.description.empty()) out += "<p>" + escaped(e.description) + "</p>\n";
  out += "<p class=\"quiet\">" + escaped(conditionText(e)) + "</p>\n";
  for (const std::string& text : identicalTexts(s)) {
    out += "<p class=\"low\">" + escaped(text) + "</p>\n";
  }
  std::string fields;
  for (std::size_t c = 0; c < results.conditions.size(); ++c) {
    fields += pathsHtml(e, results.conditions[c], c, s.conditions[c].name);
  }
  const std::vector<Table> tables = tablesOf(e, s);
  const auto leads = [](const Table& table) {
    return table.title == "Assertions" || table.title == "Table" ||
           table.title == "Results of each pairing";
  };
  for (const Table& table : tables) {
    if (leads(table)) out += tableHtml(table);
  }
  if (!fields.empty()) out += "<h2>Trajectories</h2>\n<div class=\"fields\">" + fields + "</div>\n";
  for (const Table& table : tables) {
    if (!leads(table)) out += tableHtml(table);
  }
  return out + distributionsHtml(results, s) + "</main></body></html>\n";
}

}  // namespace pitchboard::link
