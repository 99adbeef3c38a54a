// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The result of a run of an experiment: a value for each metric, how the match ended, the hash of
// the last state, and for the first runs of a condition the paths on the field. Plain values; any
// thread. Metres, seconds.

#include <cstdint>
#include <string>
#include <vector>

#include <base/geometry.h>
#include <robotlink/experiment/experiment.h>
#include <robotlink/frame/match_result.h>

namespace pitchboard::link {

struct MetricInfo {
  std::string name;  ///< name in files, assertions and columns, such as "walked_m"
  std::string unit;
  std::string title;  ///< name on the screen
  bool rate = false;  ///< each value is 0 or 1, so that the mean is a rate
  bool operator==(const MetricInfo&) const = default;
};

/// Returns the metrics in the order of RunResult::values: those of the team, of each robot, of the
/// file, of its rules, and the speed reached with team programs.
std::vector<MetricInfo> metricsOf(const Experiment& experiment);
/// Returns the name of the metric that counts how often a rule was broken.
inline std::string ruleMetric(const telemetry::Rule& rule) {
  return "rule_" + rule.name;
}
/// Returns the metrics of the team, which every experiment has.
std::vector<MetricInfo> teamMetrics();

inline constexpr std::size_t maxPathPoints = 400;  ///< in all pieces of a trajectory

/// A trajectory, or a piece of one: who is put elsewhere (the ball after a goal) gets another.
struct RunPath {
  std::string who;  ///< "ball" or a robot's name
  std::vector<Point> points;
  bool operator==(const RunPath&) const = default;
};

struct RunResult {
  std::size_t number = 1;
  std::uint64_t seed = 0;
  /// endedBy: "goal", "goal_against", "ball_out", "fell", "stuck", "time" or "full_time".
  MatchResult match;
  std::uint64_t ticks = 0;
  std::uint64_t hash = 0;      ///< hash of the last state
  std::vector<double> values;  ///< NaN if there is no value, such as a time to goal without a goal
  std::vector<RunPath> paths;  ///< empty except for the first runs of a condition
};

/// Returns the text for RunResult::match.endedBy: "goal", "ball out", "stuck".
std::string endText(const std::string& endedBy);

}  // namespace pitchboard::link
