// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What one run of an experiment gave: a value for each metric, how it ended for its teams, its
// state hash, and for the first runs of a condition the ways on the field. Plain values. Metres,
// seconds.

#include <cstdint>
#include <string>
#include <vector>

#include <base/geometry.h>
#include <robotlink/experiment/experiment.h>
#include <robotlink/frame/match_result.h>

namespace pitchboard::link {

struct MetricInfo {
  std::string name;  ///< in files, assertions and columns: "walked_m"
  std::string unit;
  std::string title;  ///< for people
  bool rate = false;  ///< 0 or 1 in each run: its mean is a rate
  bool operator==(const MetricInfo&) const = default;
};

/// Of every run of the experiment, in the order of RunResult::values: those of the team, those of
/// each robot, the file's own, and how fast a team's own programs were played.
std::vector<MetricInfo> metricsOf(const Experiment& experiment);
/// Those of the team: what every experiment has, for documents.
std::vector<MetricInfo> teamMetrics();

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
  std::uint64_t hash = 0;      ///< of the last state
  std::vector<double> values;  ///< NaN: there is none, such as the time to a goal without one
  std::vector<RunPath> paths;  ///< of the first runs of a condition
};

/// For people: "goal", "ball out", "stuck".
std::string endWords(const std::string& endedBy);

}  // namespace pitchboard::link
