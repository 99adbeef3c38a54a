// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The statistics of a live match, from the frames that were seen, and the sums that they have in
// common with those of a simulated one. Private to the library.

#include <map>

#include <robotlink/report/session_statistics.h>

namespace pitchboard::link {

/// A team's goals in each half, from the scores that are seen one after another.
class HalfScores {
 public:
  /// `half`: 0 and 1, in extra time 2 and 3.
  void see(std::size_t half, int score);
  /// Empty where the first half was not seen.
  const std::vector<int>& goals() const { return m_goals; }

 private:
  std::vector<int> m_goals;
  std::optional<int> m_last;
};

/// Who had the ball when, and the teams' sums over their robots.
class TeamSums {
 public:
  explicit TeamSums(telemetry::TimeRange range) : m_range(range) {}

  /// The part of the curves in which this time lies.
  std::size_t part(double time) const;
  void hold(RobotSummary& robot, double time, double seconds);
  TeamSummary& team(TeamColor team);
  void add(const RobotSummary& robot) { m_robots.push_back(robot); }
  SessionStatistics finish();

 private:
  telemetry::TimeRange m_range;
  std::vector<RobotSummary> m_robots;
  std::map<TeamColor, TeamSummary> m_teams;
  std::map<TeamColor, std::vector<double>> m_held;  // s in each part
};

SessionStatistics liveStatistics(const telemetry::SessionReader& session,
                                 telemetry::TimeRange range);

}  // namespace pitchboard::link
