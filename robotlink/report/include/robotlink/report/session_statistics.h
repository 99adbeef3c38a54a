// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Computes statistics of a match for its report, from the rows of a session file or in memory, or
// from the frames of a live match. Simulated matches are measured by the truth, live ones by what
// robots believed and sent. Plain values; any thread.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <base/robot_key.h>
#include <robotlink/session/row_walk.h>
#include <simcore/world/team_color.h>
#include <simcore/world/world_state.h>
#include <telemetry/wire/team_monitor.h>

namespace pitchboard::link {

/// A robot has the ball while it is the nearest one and closer than this (m).
inline constexpr double ballReach = 0.5;

struct RobotSummary {
  std::string name;     ///< of its group: "B1"
  std::string ownName;  ///< in its team's setup; may be empty
  RobotOrder order;
  TeamColor team = TeamColor::Blue;
  double seconds = 0.0;            ///< time for which there are rows, s
  std::optional<double> distance;  ///< m walked (live: of its believed places)
  std::uint32_t kicks = 0;         ///< live: kick actions that were sent
  std::uint32_t falls = 0;
  double ballSeconds = 0.0;  ///< time with the ball, s; live: by what it saw itself
  std::optional<double> errorMedian, error90;  ///< of the belief, cm; needs the truth
  /// Share of the time in which the process worked, 0 to 1; empty if the rows do not tell.
  std::array<std::optional<double>, telemetry::processCount> uptime{};
  std::vector<double> errorCurve;  ///< mean belief error, cm, in equal parts of the time; NaN: none
  /// The link of a live robot.
  struct Link {
    double received = 0.0;  ///< share of the time from its first message on, 0 to 1
    std::uint64_t messages = 0;
    std::optional<double> loss;  ///< 0 to 1; empty if its messages have no numbers
    int outages = 0, penalties = 0;
    std::optional<double> leastVolts;
  };
  std::optional<Link> link;
};

struct TeamSummary {
  TeamColor team = TeamColor::Blue;
  std::string name{};           ///< "RoboFEI"; empty: it has none
  std::optional<int> number{};  ///< the referee's; empty without a referee
  std::optional<int> score;     ///< at the end; empty if unknown
  std::vector<int> byHalf{};    ///< goals of each half; empty if the first half was not seen
  int scored = 0;               ///< goals in this range
  double ballSeconds = 0.0;
  std::uint32_t kicks = 0, falls = 0;
  double distance = 0.0;          ///< m
  std::vector<double> ballCurve;  ///< share of the time with the ball, 0 to 1, in equal parts
};

struct SessionStatistics {
  telemetry::TimeRange range;  ///< s of the source
  bool truthKnown = false;
  std::uint64_t rows = 0;
  std::vector<RobotSummary> robots;  ///< our team's first, then by team and number
  std::vector<TeamSummary> teams;    ///< those that have robots, in the same order
};

/// Number of parts of each curve.
inline constexpr std::size_t statisticsParts = 120;

/// Both read every row of the range once; for live robots they use at most 36 000 moments.
SessionStatistics statisticsOf(const telemetry::SeriesStore& rows, telemetry::TimeRange range);
SessionStatistics statisticsOf(const telemetry::SessionReader& session, telemetry::TimeRange range);

}  // namespace pitchboard::link
