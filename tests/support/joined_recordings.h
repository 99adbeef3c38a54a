// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a robot recorded itself, and what was received of it in the same match, on clocks that are
// apart by a known offset and drift. The match is simulated.

#include <QtGlobal>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <robotlink/live/board_facts.h>
#include <robotlink/session/match_sampler.h>
#include <robotlink/session/row_slot.h>
#include <telemetry/session/session_writer.h>

namespace joined_recordings {

using namespace pitchboard;

constexpr double plantedOffset = -12.345, plantedDrift = 80e-6;

/// The rows of one robot of a match, with the columns of its blackboard.
class PlayedRows : public telemetry::RowSink {
 public:
  explicit PlayedRows(std::string robot) : m_robot(std::move(robot)) {}
  telemetry::GroupId addGroup(const telemetry::GroupInfo& info) override {
    m_names.push_back(info.name);
    if (info.name == m_robot) {
      for (const telemetry::ColumnInfo& column : info.columns) {
        if (column.type != telemetry::ColumnType::Float64) columns.push_back(column);
      }
    }
    return static_cast<telemetry::GroupId>(m_names.size() - 1);
  }
  void append(telemetry::GroupId group, const telemetry::RowView& row) override {
    if (m_names[group] != m_robot) return;
    rows.emplace_back(row.time, std::vector(row.words.begin(), row.words.end()));
  }
  std::vector<telemetry::ColumnInfo> columns;
  std::vector<std::pair<double, std::vector<std::uint32_t>>> rows;

 private:
  std::string m_robot;
  std::vector<std::string> m_names;
};

inline std::shared_ptr<PlayedRows> playedBy(const std::string& robot, std::uint64_t seed,
                                            double seconds) {
  link::Scenario scenario = link::loadScenario("match-3v3").value();
  scenario.settings.seed = seed;
  scenario.stop = {};
  auto match = link::SimulatedMatch::create(scenario, {}).value();
  auto rows = std::make_shared<PlayedRows>(robot);
  link::MatchSampler sampler(rows);
  for (int i = 0; i < static_cast<int>(seconds * 60.0); ++i) {
    match.tick();
    sampler.ticked(match, {});
  }
  return rows;
}

inline telemetry::SessionWriterOptions completely() {
  telemetry::SessionWriterOptions options;
  options.waitWhenFull = true;
  return options;
}

/// As pitchboard-agent records, on a clock that is off. `part` is its number in a recording of
/// several files, which were started at the time `clock`.
inline void writeOwn(const std::string& path, const PlayedRows& played, int number, int part = 1,
                     const std::string& clock = {}) {
  telemetry::SessionInfo info;
  if (!clock.empty()) info.more = {{"clock_us", clock}, {"part", std::to_string(part)}};
  auto writer = telemetry::SessionWriter::create(path, info, completely()).value();
  telemetry::GroupInfo group{"B" + std::to_string(number), played.columns};
  group.robot = link::factsOfBoard(100 * number, 100.0, number, TeamColor::Blue);
  const auto id = writer->addGroup(group);
  for (const auto& [time, words] : played.rows) {
    writer->append(id, {(time - plantedOffset) / (1.0 + plantedDrift), words, {}});
  }
  if (!writer->finish()) qFatal("not written");
}

/// Part of the rows, by their numbers.
inline PlayedRows partOf(const PlayedRows& played, std::size_t from, std::size_t until) {
  PlayedRows part("");
  part.columns = played.columns;
  for (std::size_t i = from; i < std::min(until, played.rows.size()); ++i) {
    part.rows.push_back(played.rows[i]);
  }
  return part;
}

/// A live session with what was received of one or more robots.
class LiveSession {
 public:
  explicit LiveSession(const std::string& path) {
    telemetry::SessionInfo info;
    info.source = "live";
    m_writer = telemetry::SessionWriter::create(path, info, completely()).value();
  }
  /// Its blackboard, 20 times a second; every fifth datagram is lost, and each comes up to 5 ms
  /// late.
  void addBoard(const std::string& name, int number, const PlayedRows& played) {
    telemetry::GroupInfo group{name, played.columns};
    group.columns.emplace_back().name = "AGENT_LOSS";
    group.robot.emplace();
    group.robot->slot = group.robot->number = number;
    group.robot->sentFrom = "10.0.0.3";
    const auto id = m_writer->addGroup(group);
    const std::array<double, 1> loss{0.2};
    for (std::size_t i = 0; i < played.rows.size(); i += 3) {
      if (m_random() % 5 == 0) continue;
      m_writer->append(id, {played.rows[i].first + late(), played.rows[i].second, loss});
    }
  }
  /// Its messages, twice a second, with a few variables as text: whole numbers and one decimal.
  void addMessages(const std::string& name, int number, const PlayedRows& played) {
    telemetry::GroupInfo group{name, {}};
    const telemetry::GroupInfo all{"", played.columns};
    std::vector<link::RowSlot> places;
    for (const char* variable : {"LOCALIZATION_X", "LOCALIZATION_Y", "LOCALIZATION_THETA",
                                 "VISION_BALL_DIST", "VISION_PAN_DEG", "DECISION_ACTION_A"}) {
      group.columns.emplace_back().name = variable;
      places.push_back(link::findSlot(all, {variable}));
    }
    group.robot.emplace();
    group.robot->uid = {static_cast<std::uint32_t>(7 + m_robots++)};
    group.robot->number = number;
    group.robot->live = true;
    group.robot->sender = "10.0.0.3:1240";
    const auto id = m_writer->addGroup(group);
    std::vector<double> values(places.size());
    for (std::size_t i = 0; i < played.rows.size(); i += 30) {
      const auto& [time, words] = played.rows[i];
      for (std::size_t v = 0; v < places.size(); ++v) {
        values[v] = std::round(10.0 * places[v].read({time, words, {}})) / 10.0;
      }
      m_writer->append(id, {time + late(), {}, values});
    }
  }
  void finish() {
    m_writer->append(telemetry::SessionEvent{30.0, "bookmark", "", "here"});
    if (!m_writer->finish()) qFatal("not written");
  }

 private:
  double late() { return 0.005 * static_cast<double>(m_random() % 1000) / 1000.0; }

  std::unique_ptr<telemetry::SessionWriter> m_writer;
  std::mt19937 m_random{4};
  int m_robots = 0;
};

}  // namespace joined_recordings
