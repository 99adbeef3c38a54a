// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Small sessions for tests: two robots and the match, values that are easy to tell apart.

#include <QTemporaryDir>
#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>

#include <telemetry/mcap/mcap_cursor.h>
#include <telemetry/mcap/mcap_writer.h>
#include <telemetry/session/session_reader.h>
#include <telemetry/session/session_writer.h>

#include "../support/group_facts.h"

namespace pitchboard::telemetry::rig {

inline GroupInfo robotGroup(const std::string& name, int number) {
  return {name,
          {{"DECISION_ACTION_A",
            ColumnType::Int32,
            "",
            "Decision",
            ColumnKind::Enumeration,
            {{0, "stop"}, {1, "walk forward, \"fast\""}, {-7, "?"}}},
           {"VISION_WORKING", ColumnType::Int32, "", "Vision", ColumnKind::Flag, {}},
           {"VISION_BALL_DIST",
            ColumnType::Float32,
            "cm",
            "Vision",
            ColumnKind::Number,
            {},
            0.0,
            {{"VISION_WORKING", 2.0}, {"VISION_BALL_DIST", 0.5}}},
           {"TRUTH_X", ColumnType::Float64, "m", "Truth", ColumnKind::Number, {}},
           {"TRUTH_YAW", ColumnType::Float64, "°", "Truth", ColumnKind::Number, {}}},
          facts({{"robot", std::to_string(number)}, {"team", "blue"}, {"name", "ä\n\"b\""}})};
}

inline GroupInfo matchGroup() {
  return {"match",
          {{"BALL_X", ColumnType::Float64, "m", "", ColumnKind::Number, {}},
           {"ball x", ColumnType::Float64, "m", "", ColumnKind::Number, {}}},
          {}};
}

inline SessionInfo sessionInfo() {
  SessionInfo info;
  info.program = "pitchboard 0.1.0";
  info.source = "simulation";
  info.title = "match-3v3";
  info.seed = 0xffffffffffffffffULL;
  info.start = WallTime(std::chrono::seconds(1'700'000'000));
  info.created = info.start + std::chrono::seconds(3);
  info.more = {{"noise", "realistic"}};
  return info;
}

/// Names for session files in a folder that goes with it.
class NewSessions {
 public:
  std::string newPath() {
    return m_folder.filePath(QString::number(++m_number) + ".mcap").toStdString();
  }

 private:
  QTemporaryDir m_folder;
  int m_number = 0;
};

inline SessionWriterOptions smallChunks() {
  SessionWriterOptions options;
  options.chunkBytes = 4000;
  return options;
}

struct Row {
  GroupId group;
  double time;
  std::vector<std::uint32_t> words;
  std::vector<double> values;
  bool operator==(const Row& other) const {
    return group == other.group &&
           std::bit_cast<std::uint64_t>(time) == std::bit_cast<std::uint64_t>(other.time) &&
           words == other.words && values.size() == other.values.size() &&
           std::equal(values.begin(), values.end(), other.values.begin(), [](double a, double b) {
             return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
           });
  }
};

/// Row `tick` of robot `group` (0, 1) or of the match (2); 60 a second.
inline Row rowOf(GroupId group, int tick) {
  const double time = tick / 60.0;
  if (group == 2) return {2, time, {}, {0.1 * tick, -0.0}};
  const float distance = tick % 7 == 0 ? std::numeric_limits<float>::quiet_NaN()
                                       : 100.0F / static_cast<float>(tick + 1);
  const double yaw = tick % 5 == 0 ? -std::numeric_limits<double>::infinity() : std::sin(tick);
  return {group,
          time,
          {static_cast<std::uint32_t>(-tick), static_cast<std::uint32_t>(tick % 2),
           std::bit_cast<std::uint32_t>(distance)},
          {group + 1.0 / 3.0 * tick, yaw}};
}

inline void append(SessionWriter& writer, const Row& row) {
  writer.append(row.group, {row.time, row.words, row.values});
}

/// Rows of `ticks` ticks of two robots and the match, an event each second.
inline std::vector<Row> record(SessionWriter& writer, int ticks) {
  writer.addGroup(robotGroup("B1", 1));
  writer.addGroup(robotGroup("B2", 2));
  writer.addGroup(matchGroup());
  std::vector<Row> rows;
  for (int tick = 0; tick < ticks; ++tick) {
    for (const GroupId group : {0U, 1U, 2U}) {
      rows.push_back(rowOf(group, tick));
      append(writer, rows.back());
    }
    if (tick % 60 == 30)
      writer.append(SessionEvent{tick / 60.0, "kick", "B1", "kick " + std::to_string(tick)});
  }
  return rows;
}

inline std::vector<Row> rowsOf(const SessionReader& reader, TimeRange range) {
  std::vector<Row> rows;
  reader.rows(range, {}, [&](GroupId group, const RowView& row) {
    rows.push_back({group,
                    row.time,
                    {row.words.begin(), row.words.end()},
                    {row.values.begin(), row.values.end()}});
    return true;
  });
  return rows;
}

/// Writes the messages of a file in another order: `order` sorts them as it likes.
inline void rewrite(
    const std::string& from, const std::string& to,
    const std::function<void(std::vector<std::pair<McapMessage, std::string>>&)>& order) {
  const auto reader = McapReader::open(from);
  const McapContents& contents = reader->contents();
  auto writer = McapWriter::create(to, {contents.profile, contents.library, 3, false});
  for (const McapMetadataInfo& one : contents.metadata) {
    (void)writer->metadata(one.name, *reader->readMetadata(one));
  }
  std::vector<std::pair<McapMessage, std::string>> messages;
  for (const McapChunkInfo& chunk : contents.chunks) {
    std::string body;
    if (!reader->readChunk(chunk, body)) qFatal("a damaged chunk");
    McapCursor cursor(body);
    for (auto kind = cursor.next(); kind != McapCursor::Kind::End; kind = cursor.next()) {
      if (kind != McapCursor::Kind::Message) continue;
      messages.emplace_back(cursor.message(), std::string(cursor.message().data));
    }
  }
  order(messages);
  McapChunk chunk;
  for (const auto& [id, schema] : contents.schemas) chunk.add(schema);
  for (const auto& [id, channel] : contents.channels) chunk.add(channel);
  for (auto& [message, data] : messages) {
    message.data = data;
    chunk.add(message);
    if (chunk.bytes() < 10'000) continue;
    (void)writer->writeChunk(chunk);
    chunk.clear();
  }
  (void)writer->writeChunk(chunk);
  if (!writer->finish()) qFatal("not written");
}
using Messages = std::vector<std::pair<McapMessage, std::string>>;
inline void topicByTopic(Messages& messages) {
  std::ranges::stable_sort(messages, {}, [](const auto& one) { return one.first.channel; });
}
inline void backwards(Messages& messages) {
  std::ranges::reverse(messages);
}

inline constexpr TimeRange everything{-1e9, 1e9};

inline std::string bytesOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace pitchboard::telemetry::rig
