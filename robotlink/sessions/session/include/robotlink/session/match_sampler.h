// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Samples a simulated match once for all receivers of its rows: after each tick a row for every
// robot (its whole blackboard, truth, belief errors) and one for the match. The groups are named
// like the robots ("B1") and "match", and have RobotFacts or MatchFacts. Columns: docs/plots.md.

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <robotlink/live/board_columns.h>
#include <robotlink/match/tick_observer.h>
#include <telemetry/series/row_sink.h>

namespace pitchboard::link {

struct MatchSamplerOptions {
  int everyNth = 1;  ///< ticks per row; at least 1
};

/// There is one per match, before the other observers, called on the match's thread. It allocates
/// if robots are added, removed or changed; otherwise only the sinks do (the series store once in
/// 64 rows of a group).
class MatchSampler : public TickObserver {
 public:
  static constexpr const char* matchGroup = "match";

  /// Parts of the map's extension (docs/blackboard.md) that are in use, and recorded.
  struct Extension {
    bool used = false;        ///< the decision process of some robot is ours
    bool manyRobots = false;  ///< more than the published map has places for
    bool advised = false;     ///< some team has an advisor
    bool operator==(const Extension&) const = default;
  };

  /// If there is no sink, sampling starts when the first one is added.
  explicit MatchSampler(std::shared_ptr<telemetry::RowSink> sink = {},
                        MatchSamplerOptions options = {});
  ~MatchSampler() override;

  void ticked(const SimulatedMatch& match, std::chrono::nanoseconds tickTime) override;

  // All of this is called on the match's thread.
  /// Adds a sink, which gets the row of the present moment and then the same rows as the others.
  void add(std::shared_ptr<telemetry::RowSink> sink, const SimulatedMatch& match);
  void remove(const std::shared_ptr<telemetry::RowSink>& sink);
  void setEveryNth(int ticks) { m_options.everyNth = std::max(1, ticks); }

 private:
  struct SampledRobot {
    sim::RobotIdentity identity;
    int key = 0;
    std::string behaviour;
    std::vector<std::string> programs;
    double radius = 0.0, fieldOfView = 0.0, visionRange = 0.0;  // m, rad, m
  };
  struct Outlet {
    std::shared_ptr<telemetry::RowSink> sink;
    std::vector<telemetry::GroupId> groups;  // its ids, in the order of m_groups
  };
  void look(const SimulatedMatch& match);
  void sampleInto(std::span<const Outlet> outlets, const SimulatedMatch& match,
                  std::chrono::nanoseconds tickTime);
  void registerGroups(Outlet& outlet) const;
  bool sameRobots(const SimulatedMatch& match) const;
  void takeRobots(const SimulatedMatch& match);
  std::string groupName(const sim::RobotIdentity& robot) const;

  std::vector<Outlet> m_outlets;
  MatchSamplerOptions m_options;
  std::unique_ptr<BoardColumns> m_board;
  Extension m_extension;                       // of which m_board has the variables
  const VariableCatalog* m_catalog = nullptr;  // of which m_board is
  std::vector<telemetry::GroupInfo> m_groups;  // of the match, then of each sampled robot
  std::vector<SampledRobot> m_sampled;         // in the order of the snapshot's robots
  sim::Snapshot m_snapshot;
  std::vector<std::uint32_t> m_words;
  std::vector<double> m_truth, m_matchValues;
};

}  // namespace pitchboard::link
