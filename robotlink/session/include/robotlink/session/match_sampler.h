// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Samples a simulated match: after each tick one row for every robot (its whole blackboard, truth,
// belief errors) and one for the match. The groups are named like the robots ("B1") and "match"; a
// robot's attributes hold its identity: "robot" (number of its blackboard), "team", "number" (on
// the shirt), "key" (System V, 0: heap), "imu180" (0 or 1), "behaviour". The match's attributes:
// "physics", "seed", "tick_rate". Columns: docs/PLOTS.md.

#include <memory>
#include <string>
#include <vector>

#include <robotlink/match/match_runner.h>
#include <robotlink/session/board_columns.h>
#include <telemetry/series/row_sink.h>

namespace pitchboard::link {

struct MatchSamplerOptions {
  int everyNth = 1;  ///< ticks per row; at least 1
};

/// One for each match. Called on the match's thread. Allocates when robots come, go or change;
/// otherwise only what the sink needs (the series store: once in 64 rows of a group).
class MatchSampler : public TickObserver {
 public:
  static constexpr const char* matchGroup = "match";

  explicit MatchSampler(std::shared_ptr<telemetry::RowSink> sink, MatchSamplerOptions options = {});
  ~MatchSampler() override;

  void ticked(const SimulatedMatch& match, std::chrono::nanoseconds tickTime) override;

 private:
  struct Seat {
    sim::RobotIdentity identity;
    int key = 0;
    std::string behaviour;
    telemetry::GroupId group = 0;
  };
  bool sameRobots(const SimulatedMatch& match) const;
  void takeRobots(const SimulatedMatch& match);
  std::string groupName(const sim::RobotIdentity& robot) const;

  std::shared_ptr<telemetry::RowSink> m_sink;
  const MatchSamplerOptions m_options;
  std::unique_ptr<BoardColumns> m_board;
  const VariableCatalog* m_catalog = nullptr;  // of which m_board is
  telemetry::GroupId m_match = 0;
  std::vector<Seat> m_seats;  // in the order of the snapshot's robots
  sim::Snapshot m_snapshot;
  std::vector<std::uint32_t> m_words;
  std::vector<double> m_truth, m_matchValues;
};

}  // namespace pitchboard::link
