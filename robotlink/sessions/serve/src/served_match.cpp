// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/serve/served_match.h>

#include <nlohmann/json.hpp>

#include <bit>
#include <cmath>
#include <utility>

#include <robotlink/match/simulated_match.h>
#include <robotlink/session/session_events.h>
#include <simcore/simulation/simulation.h>
#include <telemetry/series/losable.h>
#include <telemetry/session/row_topic.h>
#include <telemetry/session/session_reader.h>

#include "scene_json.h"

namespace pitchboard::link {
namespace {

using Json = nlohmann::json;
using telemetry::ColumnInfo;
using telemetry::ColumnType;
using telemetry::FoxgloveChannel;
using telemetry::GroupId;
using telemetry::GroupInfo;
using telemetry::RowView;

// Channels of groups follow.
constexpr std::uint32_t fieldChannel = 1, eventChannel = 2, logChannel = 3;

constexpr const char* eventSchema =
    R"({"title":"pitchboard.Event","type":"object","properties":{"time":{"type":"number"},)"
    R"("kind":{"type":"string"},"group":{"type":"string"},"text":{"type":"string"}}})";
constexpr const char* logSchema =
    R"({"title":"foxglove.Log","type":"object","properties":{"timestamp":{"type":"object",)"
    R"("properties":{"sec":{"type":"integer"},"nsec":{"type":"integer"}}},)"
    R"("level":{"type":"integer"},"message":{"type":"string"},"name":{"type":"string"},)"
    R"("file":{"type":"string"},"line":{"type":"integer"}}})";

FoxgloveChannel jsonChannel(std::uint32_t id, std::string topic, std::string schemaName,
                            std::string schema) {
  return {id, std::move(topic), "json", std::move(schemaName), std::move(schema), "jsonschema"};
}

std::string schemaOf(const GroupInfo& group) {
  Json properties{{"time", {{"type", "number"}, {"description", "s of the source"}}}};
  for (const ColumnInfo& column : group.columns) {
    Json& property = properties[column.name];
    property["type"] = column.type == ColumnType::Int32 ? "integer" : "number";
    if (!column.unit.empty()) property["description"] = column.unit;
  }
  return Json{{"title", "pitchboard.Row"}, {"type", "object"}, {"properties", properties}}.dump(
      -1, ' ', false, Json::error_handler_t::replace);
}

/// Unknown values are null: JSON has no NaN.
Json valueOf(const telemetry::Slot& slot, const RowView& row) {
  double number = std::nan("");
  if (slot.type == ColumnType::Float64) {
    if (slot.index < row.values.size()) number = row.values[slot.index];
  } else if (slot.index < row.words.size()) {
    const std::uint32_t word = row.words[slot.index];
    if (slot.type == ColumnType::Int32) return std::bit_cast<std::int32_t>(word);
    number = static_cast<double>(std::bit_cast<float>(word));
  }
  return std::isfinite(number) ? Json(number) : Json();
}

/// A row that outlives the call that brought it.
struct KeptRow {
  double time;
  std::vector<std::uint32_t> words;
  std::vector<double> values;
  explicit KeptRow(const RowView& row)
      : time(row.time),
        words(row.words.begin(), row.words.end()),
        values(row.values.begin(), row.values.end()) {}
  RowView view() const { return {time, words, values}; }
};

}  // namespace

/// What the columns of a group are called, and where their values stand in a row.
struct ServedMatch::Columns {
  explicit Columns(const GroupInfo& info)
      : places(telemetry::slotsOf(info.columns)), losable(telemetry::losableColumns(info)) {
    for (const ColumnInfo& column : info.columns) names.push_back(column.name);
  }
  std::string json(const RowView& row) const {
    Json json{{"time", row.time}};
    auto rule = losable.begin();
    for (std::size_t c = 0; c < places.size(); ++c) {
      const bool isLosable = rule != losable.end() && rule->column == c;
      const bool isLost = isLosable && rule->isLost(row);
      if (isLosable) ++rule;
      json[names[c]] = isLost ? Json() : valueOf(places[c], row);
    }
    return json.dump();
  }
  std::vector<std::string> names;
  std::vector<telemetry::Slot> places;
  std::vector<telemetry::Losable> losable;
};

std::function<std::uint64_t(double)> logTimesFrom(telemetry::WallTime start) {
  return [begin = static_cast<std::uint64_t>(start.time_since_epoch().count())](double seconds) {
    return begin + static_cast<std::uint64_t>(std::llround(seconds * 1e9));
  };
}

ServedMatch::ServedMatch(telemetry::FoxgloveServer& server,
                         std::function<std::uint64_t(double)> logTime)
    : m_server(server), m_logTime(std::move(logTime)) {
  m_server.advertise(jsonChannel(fieldChannel, "/field", "foxglove.SceneUpdate", sceneSchema));
  m_server.advertise(jsonChannel(eventChannel, "/events", "pitchboard.Event", eventSchema));
  m_server.advertise(jsonChannel(logChannel, "/log", "foxglove.Log", logSchema));
}

GroupId ServedMatch::addGroup(const GroupInfo& info) {
  std::size_t at = 0;
  while (at < m_groups.size() && !telemetry::isSameGroup(m_groups[at].info, info)) ++at;
  const bool isNew = at == m_groups.size();
  if (isNew) m_groups.emplace_back();
  Group& group = m_groups[at];
  const bool isOffered =
      !isNew && group.info.name == info.name && group.info.columns == info.columns;
  group.info = info;
  if (isOffered) return static_cast<GroupId>(at);
  // A channel's id is not used again: who subscribed to "B1" must not get the rows of "R1".
  if (!isNew) m_server.unadvertise(group.channel);
  group.channel = m_nextChannel++;
  group.columns = std::make_shared<const Columns>(info);
  m_server.advertise(
      jsonChannel(group.channel, telemetry::rowTopic(info), "pitchboard.Row", schemaOf(info)));
  return static_cast<GroupId>(at);
}

void ServedMatch::append(GroupId id, const RowView& row) {
  if (id >= m_groups.size()) return;
  const Group& group = m_groups[id];
  m_server.sendKept(
      group.channel, m_logTime(row.time),
      [columns = group.columns, kept = KeptRow(row)] { return columns->json(kept.view()); });
}

void ServedMatch::append(const telemetry::SessionEvent& event) {
  m_server.send(eventChannel, m_logTime(event.time), telemetry::sessionEventJson(event));
}

void ServedMatch::append(const LogLine& line) {
  constexpr std::uint64_t second = 1'000'000'000;
  const std::uint64_t time = m_logTime(line.time);
  // The levels are those of foxglove.Log.
  const Json json{{"timestamp", {{"sec", time / second}, {"nsec", time % second}}},
                  {"level", static_cast<int>(line.level)},
                  {"message", line.text},
                  {"name", line.origin},
                  {"file", ""},
                  {"line", 0}};
  m_server.send(logChannel, time, json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

void ServedMatch::show(const MatchFrame& frame) {
  const std::uint64_t time = m_logTime(frame.snapshot.time);
  m_server.sendKept(fieldChannel, time, [frame, time] { return sceneJson(frame, time); });
}

void ServedMatch::setTime(double time) {
  m_server.setTime(m_logTime(time));
}

void MatchServing::ticked(const SimulatedMatch& match, std::chrono::nanoseconds /*tickTime*/) {
  const sim::Simulation& simulation = match.simulation();
  if (simulation.state().tick % static_cast<std::uint64_t>(m_everyNth) != 0) return;
  simulation.snapshot(m_snapshot);
  MatchFrame frame;
  frame.snapshot = m_snapshot;
  frame.teams = teamsByColour();
  for (const sim::RobotSnapshot& one : m_snapshot.robots) {
    RobotFrame robot;
    static_cast<sim::RobotSnapshot&>(robot) = one;
    robot.key = keyOf(one.identity);
    robot.name = one.identity.name();
    frame.robots.push_back(std::move(robot));
  }
  auto settings = std::make_shared<FrameSettings>();
  settings->field = simulation.state().settings.field;
  frame.settings = std::move(settings);
  m_served->show(frame);
  m_served->setTime(m_snapshot.time);
}

void MatchServing::happened(std::span<const MatchEvent> events) {
  for (const MatchEvent& event : events) m_served->append(sessionEvent(event));
}

void MatchServing::logged(const LogLine& line) {
  m_served->append(line);
}

void LiveServing::happened(const MatchEvent& event) {
  m_served->append(sessionEvent(event));
}

void LiveServing::frameMade(const MatchFrame& frame) {
  m_served->show(frame);
  m_served->setTime(frame.snapshot.time);
}

}  // namespace pitchboard::link
