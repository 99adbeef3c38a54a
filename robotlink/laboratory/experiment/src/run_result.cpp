// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/experiment/run_result.h>

#include <algorithm>
#include <array>

#include "run_layout.h"

namespace pitchboard::link {
namespace {

struct TeamMetric {
  const char *name, *unit, *title;
  bool rate = false;
};

// In the order of TeamValue.
constexpr std::array<TeamMetric, teamValueCount> teamTable{{
    {"success", "", "Good runs", true},
    {"goal", "", "Runs with a goal", true},
    {"goal_against", "", "Runs with a goal against", true},
    {"ball_out", "", "Runs with the ball out", true},
    {"stuck", "", "Runs that got stuck", true},
    {"fell", "", "Runs with a fall", true},
    {"timeout", "", "Runs that ran out of time", true},
    {"goals", "", "Goals"},
    {"goals_against", "", "Goals against"},
    {"time_s", "s", "Time"},
    {"time_to_goal_s", "s", "Time to the first goal"},
    {"walked_m", "m", "Distance walked"},
    {"displacement_m", "m", "From the start to the end"},
    {"kicks", "", "Kicks"},
    {"falls", "", "Falls"},
    {"balls_out", "", "Times the ball was out"},
    {"belief_error_m", "m", "Belief error"},
    {"belief_error_end_m", "m", "Belief error at the end"},
    {"possession", "", "Share of possession"},
    {"collisions", "", "Collisions"},
    {"penalties", "", "Penalties"},
    {"ball_attended", "", "Share of the time in play with a robot at the ball"},
    {"supporters_close", "", "Share of the time in play with supporters in each other's way"},
    {"passes", "", "Passes of both teams"},
    {"passes_own", "", "Passes"},
    {"removals_team_half", "", "Removals of a team in a half"},
    {"removals_again", "", "Removed again within 30 s"},
    {"removals_pushing", "", "Removals for pushing"},
    {"removals_incapable", "", "Removals of fallen robots"},
    {"removals_position", "", "Removals for an illegal position"},
    {"removals_in_set", "", "Removals for moving in SET"},
    {"removals_stuck", "", "Removals from a stuck ball"},
    {"removals_leaving", "", "Removals for leaving the field"},
    {"longest_stuck_s", "s", "Longest time that a robot was stuck"},
    {"illegal_transitions", "", "Illegal state transitions"},
    {"ready_s", "s", "A READY"},
}};
static_assert(teamTable.back().name != nullptr, "every TeamValue needs its row");

constexpr std::array<TeamMetric, robotValueCount> robotTable{{
    {"walked_m", "m", "Distance walked"},
    {"kicks", "", "Kicks"},
    {"belief_error_m", "m", "Belief error"},
}};

struct EndText {
  const char *endedBy, *text;
};
constexpr std::array<EndText, 7> ends{{{"goal", "goal"},
                                       {"goal_against", "goal against"},
                                       {"ball_out", "ball out"},
                                       {"fell", "fell"},
                                       {"stuck", "stuck"},
                                       {"time", "time was up"},
                                       {"full_time", "final whistle"}}};

}  // namespace

std::vector<std::string> robotsOf(const Experiment& experiment) {
  std::vector<std::string> names;
  for (const Condition& condition : experiment.conditions) {
    for (const ScenarioRobot& robot : condition.scenario.robots) {
      const std::string name = robot.identity.name();
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

std::vector<MetricInfo> teamMetrics() {
  std::vector<MetricInfo> out;
  for (const TeamMetric& one : teamTable) out.push_back({one.name, one.unit, one.title, one.rate});
  return out;
}

std::vector<MetricInfo> metricsOf(const Experiment& experiment) {
  std::vector<MetricInfo> out = teamMetrics();
  for (const std::string& robot : robotsOf(experiment)) {
    for (const TeamMetric& one : robotTable) {
      out.push_back({std::string(one.name) + '_' + robot, one.unit,
                     robot + ": " + std::string(one.title), one.rate});
    }
  }
  for (const ExpressionMetric& metric : experiment.metrics) {
    out.push_back({metric.name, metric.unit, metric.name, false});
  }
  for (const telemetry::Rule& rule : experiment.rules) {
    out.push_back({ruleMetric(rule), "", "Times broken: " + rule.name, false});
  }
  // A measured time differs from run to run, which those of reference processes must not.
  if (experiment.hasTeamPrograms()) {
    out.push_back({"times_real_time", "", "Speed (times real time)", false});
    out.push_back(
        {"own_programs_kept", "", "Share of that speed that team programs reached", false});
  }
  return out;
}

std::string endText(const std::string& endedBy) {
  const auto found = std::ranges::find(ends, endedBy, &EndText::endedBy);
  return found == ends.end() ? endedBy : found->text;
}

}  // namespace pitchboard::link
