// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How groups, rows and messages look inside a session file (docs/file-formats.md). Rows are CDR
// (OMG, little-endian, plain, version 1) by a ros2msg definition made from the columns.

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <base/result.h>
#include <telemetry/mcap/mcap_records.h>
#include <telemetry/session/row_topic.h>
#include <telemetry/session/session_types.h>

namespace pitchboard::telemetry::session {

inline constexpr std::string_view metadataName = "pitchboard";
inline constexpr std::string_view checkKey = "check";             ///< CRC-32 of the other metadata
inline constexpr std::string_view groupKey = "pitchboard.group";  ///< of a row channel's metadata
/// Metadata that say what a group is called from there on.
inline constexpr std::string_view factsName = "pitchboard.group";

struct StreamInfo {
  std::string_view topic, schemaName, jsonSchema;
};
/// By SessionStream.
extern const std::array<StreamInfo, sessionStreamCount> streams;

/// SessionEvent::kind of what a person marked.
inline constexpr std::string_view bookmarkKind = "bookmark";
inline constexpr std::string_view noteKind = "note";  ///< kept in the file beside the recording

/// Returns the stream of a channel; empty for rows and for unknown channels.
std::optional<SessionStream> streamOf(const McapChannel& channel);

McapMap toMetadata(const SessionInfo& info);
std::string checkOf(const McapMap& metadata);
/// The version of the format is left in `format`; fields that are missing keep their defaults.
/// Nothing when the check fails.
std::optional<SessionInfo> infoFromMetadata(const McapMap& metadata, int& format);

/// What may change of a group that has an id.
struct GroupFacts {
  std::string name;
  std::optional<RobotFacts> robot;
  std::optional<MatchFacts> match;
  bool operator==(const GroupFacts&) const = default;
};
McapMap toMetadata(const std::string& id, const GroupFacts& facts);
/// The id and the facts. Nothing when the check fails.
std::optional<std::pair<std::string, GroupFacts>> factsFromMetadata(const McapMap& metadata);

std::string groupToJson(const GroupInfo& group);
/// Nothing when it is not of its form or its 32-bit columns do not stand first.
std::optional<GroupInfo> groupFromJson(std::string_view json);

/// Names that ros2msg allows (lower case, digits, single underscores), one per column, all
/// different: "VISION_BALL_DIST" is "vision_ball_dist". None is "source_time", the time's own
/// field.
std::vector<std::string> fieldNames(const GroupInfo& group);
std::string rowSchemaName(const GroupInfo& group);
std::string rowSchema(const GroupInfo& group);

/// A Float64 column that is kept as single precision.
inline bool isSingle(const ColumnInfo& column) {
  return column.type == ColumnType::Float64 && column.resolution > 0.0 &&
         column.resolution < std::numeric_limits<double>::infinity();
}

/// Where the parts of a row stand in its bytes: time, words, singles, doubles.
struct RowLayout {
  std::size_t words = 0, values = 0;
  static constexpr std::size_t timeAt = 4, wordsAt = 12;
  std::size_t singlesAt = 0, doublesAt = 0, size = 0;
  struct Single {
    std::size_t index;  ///< among the values
    double resolution;
  };
  std::vector<Single> singles;
  std::vector<std::size_t> doubles;  ///< indices among the values

  RowLayout() = default;
  explicit RowLayout(const GroupInfo& group);
  /// Returns whether the bytes of a row are its time and then its values, as they are.
  bool isCopied(const RowView& row) const {
    return words == 0 && singles.empty() && values > 0 && row.values.size() == values;
  }
  /// The bytes in front of the values then.
  static std::array<char, wordsAt> headOf(const RowView& row);
  /// `to` has `size` bytes; a row that is too short is filled up with zeros. Singles are rounded.
  void write(char* to, const RowView& row) const;
  /// False when the bytes are not a row of this layout. `words` and `values` are reused.
  bool read(std::string_view bytes, double& time, std::vector<std::uint32_t>& wordsOut,
            std::vector<double>& valuesOut) const;
};

std::string toJson(const SessionEvent& event);
std::string toJson(const LogLine& line, std::uint64_t wallNanoseconds);
std::string toJson(const SessionDatagram& datagram);
std::optional<SessionEvent> eventFromJson(std::string_view json);
std::optional<LogLine> logLineFromJson(std::string_view json);
std::optional<SessionDatagram> datagramFromJson(std::string_view json);
/// The "time" of any message.
std::optional<double> timeFromJson(std::string_view json);

/// Nanoseconds since 1970 of a source's time; times that do not fit are clamped.
std::uint64_t nanoseconds(WallTime start, double seconds);

}  // namespace pitchboard::telemetry::session
