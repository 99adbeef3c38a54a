// SPDX-License-Identifier: GPL-3.0-or-later
// What learning writes at its end: best.json, curve.csv, report.html.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include <base/lined_json.h>
#include <robotlink/learn/learn.h>
#include <robotlink/report/report_page.h>

namespace pitchboard::link {
namespace {

using BestJson = nlohmann::ordered_json;

std::string signedFixed(double value) {
  return (value >= 0.0 ? "+" : "") + fixed(value, 2);
}

/// The mean and the standard deviation of a coordinate over the points of a generation.
SampleMoments coordinate(const Learning& learning, const Generation& generation, std::size_t i) {
  std::vector<double> values;
  for (const auto& point : generation.points) values.push_back(learning.parameters[i].at(point[i]));
  return momentsOf(values);
}

/// Curves over generations, as inline SVG.
class CurveChart {
 public:
  struct Curve {
    const char* colour;
    std::vector<double> values;
  };
  explicit CurveChart(std::vector<Curve> curves) : m_curves(std::move(curves)) {
    for (const Curve& curve : m_curves) {
      for (const double value : curve.values) {
        m_low = std::min(m_low, value);
        m_high = std::max(m_high, value);
      }
    }
    const double room = std::max(0.05 * (m_high - m_low), 1e-9);
    m_low -= room;
    m_high += room;
  }

  std::string svg() const {
    std::string out = "<svg class=\"chart\" viewBox=\"0 0 440 150\">";
    for (const double share : {0.0, 0.5, 1.0}) {
      const double y = bottom - share * (bottom - top);
      out += "<line class=\"grid\" x1=\"44\" x2=\"434\" y1=\"" + fixed(y, 1) + "\" y2=\"" +
             fixed(y, 1) + "\"/><text class=\"axis\" text-anchor=\"end\" x=\"39\" y=\"" +
             fixed(y + 4, 1) + "\">" + shortest(rounded(std::lerp(m_low, m_high, share))) +
             "</text>";
    }
    std::size_t most = 0;
    for (const Curve& curve : m_curves) {
      most = std::max(most, curve.values.size());
      std::string path;
      for (std::size_t i = 0; i < curve.values.size(); ++i) {
        const double y = bottom - (curve.values[i] - m_low) / (m_high - m_low) * (bottom - top);
        path +=
            (path.empty() ? "M" : "L") + fixed(xOf(i, curve.values.size()), 1) + ' ' + fixed(y, 1);
      }
      out += "<path class=\"curve " + std::string(curve.colour) + "\" d=\"" + path + "\"/>";
    }
    out +=
        "<text class=\"axis\" x=\"44\" y=\"146\">1</text><text class=\"axis\" x=\"434\" y=\"146\" "
        "text-anchor=\"end\">generation " +
        std::to_string(most) + "</text>";
    return out + "</svg>";
  }

 private:
  static constexpr double top = 10, bottom = 128;
  static double xOf(std::size_t i, std::size_t count) {
    return count < 2 ? 239.0
                     : 44.0 + 390.0 * static_cast<double>(i) / static_cast<double>(count - 1);
  }
  /// Three significant digits.
  static double rounded(double value) {
    if (value == 0.0) return 0.0;
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 2.0);
    return std::stod(fixed(std::round(value / unit) * unit, 6));
  }
  std::vector<Curve> m_curves;
  double m_low = std::numeric_limits<double>::max(), m_high = std::numeric_limits<double>::lowest();
};

std::string totalsRow(const std::string& opponent, const MatchTotals& totals) {
  std::string range = "–";
  if (totals.difference95) {
    range = signedFixed(totals.difference95->low) + " to " + signedFixed(totals.difference95->high);
  }
  return "<tr><td class=\"l\">" + escaped(opponent) + "</td><td>" +
         std::to_string(totals.played()) + "</td><td>" + std::to_string(totals.won) + "</td><td>" +
         std::to_string(totals.drawn) + "</td><td>" + std::to_string(totals.lost) + "</td><td>" +
         std::to_string(totals.goals) + " : " + std::to_string(totals.goalsAgainst) + "</td><td>" +
         signedFixed(totals.difference) + "</td><td>" + range + "</td></tr>\n";
}

std::string validationTable(const LearnedTeam& team) {
  std::string out =
      "<div class=\"scroll\"><table><thead><tr><th class=\"l\">Opponent</th><th>Matches</th>"
      "<th>Won</th><th>Drawn</th><th>Lost</th><th>Goals</th><th>Difference</th><th>95 %</th></tr>"
      "</thead><tbody>\n";
  for (const auto& pairing : team.summary.tournament->pairings) {
    out += totalsRow(pairing.second, pairing.totals);
  }
  return out + "</tbody></table></div>\n";
}

std::string parameterTable(const Learning& learning, const LearnedTeam& team) {
  std::string out =
      "<div class=\"scroll\"><table><thead><tr><th class=\"l\">Parameter</th><th>Unit</th>"
      "<th>Start</th><th>Learned</th><th>Range</th></tr></thead><tbody>\n";
  for (std::size_t i = 0; i < learning.parameters.size(); ++i) {
    const LearnedParameter& one = learning.parameters[i];
    out += "<tr><td class=\"l\">" + one.key + "</td><td>" + escaped(one.unit) + "</td><td>" +
           shortest(one.start) + "</td><td>" + shortest(team.values[i]) + "</td><td>" +
           shortest(one.from) + " to " + shortest(one.to) + "</td></tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

struct ObjectiveCurves {
  std::vector<double> mean, best;
};

ObjectiveCurves curvesOf(const LearnedTeam& team) {
  ObjectiveCurves out;
  for (const Generation& one : team.generations) {
    out.mean.push_back(momentsOf(one.values).mean);
    out.best.push_back(*std::ranges::max_element(one.values));
  }
  return out;
}

}  // namespace

std::string bestJson(const Learning& learning, const LearnedTeam& team,
                     const std::string& program) {
  BestJson parameters = BestJson::object(), validation = BestJson::array();
  for (std::size_t i = 0; i < learning.parameters.size(); ++i) {
    parameters[learning.parameters[i].key] = team.values[i];
  }
  for (const auto& [first, second, totals] : team.summary.tournament->pairings) {
    BestJson one{{"opponent", second},
                 {"matches", totals.played()},
                 {"won", totals.won},
                 {"drawn", totals.drawn},
                 {"lost", totals.lost},
                 {"goals", totals.goals},
                 {"goals_against", totals.goalsAgainst},
                 {"goal_difference", totals.difference}};
    if (totals.difference95) {
      one["goal_difference_95"] = {totals.difference95->low, totals.difference95->high};
    }
    validation.push_back(std::move(one));
  }
  const BestJson out{{"version", 1},
                     {"name", learning.name},
                     {"parameters", parameters},
                     {"learned",
                      {{"program", program},
                       {"objective", learning.objective},
                       {"generations", team.generations.size()},
                       {"population", learning.population},
                       {"matches", learning.matches},
                       {"chosen", team.from},
                       {"validation", validation}}}};
  return out.dump(2) + '\n';
}

std::string curveCsv(const Learning& learning, const LearnedTeam& team) {
  std::string out = "generation,objective_mean,objective_best,objective_sd";
  for (const LearnedParameter& one : learning.parameters) {
    out += ',' + one.key + ',' + one.key + "_sd";
  }
  out += '\n';
  for (std::size_t g = 0; g < team.generations.size(); ++g) {
    const Generation& generation = team.generations[g];
    const SampleMoments objective = momentsOf(generation.values);
    out += std::to_string(g + 1) + ',' + shortest(objective.mean) + ',' +
           shortest(*std::ranges::max_element(generation.values)) + ',' +
           shortest(objective.deviation);
    for (std::size_t i = 0; i < learning.parameters.size(); ++i) {
      out += ',' + shortest(learning.parameters[i].at(team.means[g][i])) + ',' +
             shortest(coordinate(learning, generation, i).deviation);
    }
    out += '\n';
  }
  return out;
}

std::string learnReportHtml(const Learning& learning, const LearnedTeam& team,
                            const std::string& program) {
  const std::string name = escaped(learning.name);
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + name +
      "</title><style>" + std::string(reportStyle) + "</style></head><body><main>\n<h1>" + name +
      "</h1>\n<p class=\"quiet\">Learned in " + std::to_string(team.generations.size()) +
      " generations of " + std::to_string(learning.population) + " candidates, " +
      std::to_string(learning.matches) +
      " matches of each against each opponent. Larger is better: <code>" +
      escaped(learning.objective) + "</code></p>\n";
  out +=
      "<h2>Validation</h2>\n<p>Played once, by the chosen candidate alone, with seeds that no "
      "candidate has seen.</p>\n" +
      validationTable(team);
  for (const CheckedAssertion& one : team.summary.assertions) {
    out += "<p>" + std::string(one.holds ? "Holds: " : "<b class=\"low\">Failed:</b> ") +
           escaped(one.condition + ": " + one.text + " (" + one.values + ")") + "</p>\n";
  }
  out += "<h2>Choice</h2>\n<p>Chosen: " + escaped(team.from) + ", with " +
         fixed(team.objective, 3) + " on average in up to " + std::to_string(team.choosingMatches) +
         " matches against each opponent. The values of the start reached " +
         fixed(team.objectiveOfStart, 3) + " in their matches.</p>\n";
  const ObjectiveCurves curves = curvesOf(team);
  out += "<h2>Learning curve</h2>\n<div class=\"charts\"><figure>" +
         CurveChart({{"blue", curves.mean}, {"orange", curves.best}}).svg() +
         "<figcaption>The objective: the mean of each generation (blue) and its best candidate "
         "(orange). Every generation plays other seeds.</figcaption></figure></div>\n";
  out += "<h2>Parameters</h2>\n" + parameterTable(learning, team) +
         "<h2>Parameters over generations</h2>\n<div class=\"charts\">\n";
  for (std::size_t i = 0; i < learning.parameters.size(); ++i) {
    std::vector<double> mean, low, high;
    for (std::size_t g = 0; g < team.generations.size(); ++g) {
      const SampleMoments spread = coordinate(learning, team.generations[g], i);
      mean.push_back(learning.parameters[i].at(team.means[g][i]));
      low.push_back(spread.mean - spread.deviation);
      high.push_back(spread.mean + spread.deviation);
    }
    out += "<figure><h3><span>" + learning.parameters[i].key + "</span><span class=\"quiet\">" +
           escaped(learning.parameters[i].unit) + "</span></h3>" +
           CurveChart({{"black", low}, {"black", high}, {"blue", mean}}).svg() + "</figure>\n";
  }
  out += "</div>\n<footer>" + escaped(program) +
         ". Blue: the centre of the search; grey: one standard deviation of its candidates."
         "</footer>\n</main></body></html>\n";
  return out;
}

}  // namespace pitchboard::link
