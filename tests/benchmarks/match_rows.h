// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Rows of a played match for the benchmarks of sessions: every blackboard variable and the truth of
// each robot, every tick.

#include <numbers>

#include <robotlink/simulated_match.h>
#include <robotlink/variable_catalog.h>
#include <telemetry/series_types.h>

namespace pitchboard::link {

class MatchRows {
 public:
  explicit MatchRows(SimulatedMatch& match) : m_match(match) {
    const auto& catalog = VariableCatalog::published();
    for (const sim::RobotSnapshot& robot : match.simulation().snapshot().robots) {
      telemetry::GroupInfo group;
      group.name = "R" + std::to_string(robot.identity.id.value);
      group.attributes["robot"] = std::to_string(robot.identity.id.value);
      for (const Variable& variable : catalog.variables()) {
        group.columns.push_back({variable.name,
                                 variable.type == VariableType::Int
                                     ? telemetry::ColumnType::Int32
                                     : telemetry::ColumnType::Float32,
                                 "", "", telemetry::ColumnKind::Number, {}});
      }
      for (const char* name : {"TRUTH_X", "TRUTH_Y", "TRUTH_YAW", "BALL_X", "BALL_Y"}) {
        group.columns.push_back({name, telemetry::ColumnType::Float64, "m", "Truth",
                                 telemetry::ColumnKind::Number, {}});
      }
      m_groups.push_back(std::move(group));
    }
  }

  const std::vector<telemetry::GroupInfo>& groups() const { return m_groups; }
  static constexpr std::size_t columns = 83 + 122 + 5;

  /// Calls back with (group index, row) for every robot.
  template <class Visit>
  void sample(Visit&& visit) {
    m_match.simulation().snapshot(m_snapshot);
    const auto& catalog = VariableCatalog::published();
    const double time = static_cast<double>(m_match.simulation().state().tick) /
                        m_match.simulation().state().settings.tickRate;
    for (std::size_t i = 0; i < m_snapshot.robots.size(); ++i) {
      const auto& robot = m_snapshot.robots[i];
      std::array<std::uint32_t, Blackboard::words> board;
      m_match.blackboard(robot.identity.id)->copyWords(board);
      m_words.clear();
      for (const Variable& variable : catalog.variables()) {
        const int offset = variable.type == VariableType::Int ? 0 : Blackboard::floatOffset;
        m_words.push_back(board[static_cast<std::size_t>(offset + variable.index)]);
      }
      const std::array<double, 5> values{robot.pose.position.x, robot.pose.position.y,
                                         robot.pose.yaw, m_snapshot.ball.x,
                                         m_snapshot.ball.y};
      visit(static_cast<telemetry::GroupId>(i), telemetry::RowView{time, m_words, values});
    }
  }

 private:
  SimulatedMatch& m_match;
  std::vector<telemetry::GroupInfo> m_groups;
  sim::Snapshot m_snapshot;
  std::vector<std::uint32_t> m_words;
};

}  // namespace pitchboard::link
