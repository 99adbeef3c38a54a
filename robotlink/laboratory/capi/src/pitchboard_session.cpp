// SPDX-License-Identifier: GPL-3.0-or-later
// The C interface of sessions: reads them with SessionReader into arrays that the caller frees.
#include <pitchboard_session.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <base/try.h>
#include <robotlink/session/session_events.h>
#include <telemetry/series/group_attributes.h>
#include <telemetry/series/group_order.h>
#include <telemetry/series/losable.h>
#include <telemetry/session/session_reader.h>
#include <telemetry/statistics/curve_statistics.h>

#include "c_interface.h"

using namespace pitchboard;
using namespace pitchboard::link;
using namespace pitchboard::link::capi;
using telemetry::ColumnInfo;
using telemetry::ColumnType;
using telemetry::GroupInfo;
using telemetry::Losable;
using telemetry::RowView;
using telemetry::SessionGroup;
using telemetry::SessionReader;
using telemetry::TimeRange;

namespace {

struct LockedSession {
  explicit LockedSession(SessionReader made) : reader(std::move(made)) {}
  std::mutex mutex;
  SessionReader reader;
};

/// An array of one type.
struct DataPart {
  pb_type type = PB_FLOAT64;
  std::vector<std::uint32_t> words{};  ///< of PB_INT32 and PB_FLOAT32
  std::vector<double> values{};        ///< of PB_FLOAT64
  std::string text{};                  ///< of PB_CHARS
};
using DataParts = std::vector<DataPart>;

// Never destroyed: a program may call from an atexit handler.
auto& sessionHandles() {
  static auto* handles = new Handles<LockedSession, pb_session>;
  return *handles;
}
auto& dataHandles() {
  static auto* handles = new Handles<const DataParts, pb_data>;
  return *handles;
}

/// Gives the caller the parts that read(SessionReader&) returns.
template <class Read>
pb_status readSession(const pb_session* handle, pb_data** data, const Read& read) {
  return guarded([&] {
    if (data == nullptr) return missing("data");
    *data = nullptr;
    return withHandle(sessionHandles(), handle, "session", [&](LockedSession& found) {
      Result<DataParts> parts = read(found.reader);
      if (!parts) return reportStatus(tl::unexpected(parts.error()));
      *data = dataHandles().add(std::make_shared<const DataParts>(std::move(*parts)));
      return reportStatus(PB_OK, "");
    });
  });
}

DataParts textParts(std::string text) {
  DataParts parts(1);
  parts[0].type = PB_CHARS;
  parts[0].text = std::move(text);
  return parts;
}

std::string jsonText(const nlohmann::json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

pb_type typeOf(const ColumnInfo& column) {
  switch (column.type) {
    case ColumnType::Int32:
      return PB_INT32;
    case ColumnType::Float32:
      return PB_FLOAT32;
    case ColumnType::Float64:
      break;
  }
  return PB_FLOAT64;
}

const char* kindName(telemetry::ColumnKind kind) {
  switch (kind) {
    case telemetry::ColumnKind::Flag:
      return "flag";
    case telemetry::ColumnKind::Enumeration:
      return "enumeration";
    case telemetry::ColumnKind::Text:
      return "text";
    case telemetry::ColumnKind::Number:
      break;
  }
  return "number";
}

nlohmann::json descriptionOf(const SessionReader& session) {
  const telemetry::SessionInfo& info = session.info();
  nlohmann::json out{{"program", info.program},
                     {"source", info.source},
                     {"title", info.title},
                     {"start_ns", info.start.time_since_epoch().count()},
                     {"created_ns", info.created.time_since_epoch().count()},
                     {"more", info.more},
                     {"complete", session.complete()},
                     {"recording", session.isGrowing()},
                     {"damaged", session.isDamaged()},
                     {"notes", session.notes()},
                     {"groups", nlohmann::json::array()}};
  if (info.seed) out["seed"] = *info.seed;
  if (const auto range = session.range()) {
    out["from"] = range->begin;
    out["until"] = range->end;
  }
  for (const std::size_t g : listedOrder(session.groups(), &SessionGroup::info)) {
    const SessionGroup& group = session.groups()[g];
    nlohmann::json columns = nlohmann::json::array();
    for (const ColumnInfo& column : group.info.columns) {
      nlohmann::json labels = nlohmann::json::object();
      for (const auto& [code, label] : column.labels) labels[std::to_string(code)] = label;
      columns.push_back({{"name", column.name},
                         {"type", typeOf(column)},
                         {"unit", column.unit},
                         {"category", column.category},
                         {"kind", kindName(column.kind)},
                         {"labels", std::move(labels)}});
    }
    out["groups"].push_back({{"index", g},
                             {"name", group.info.name},
                             {"rows", group.rows},
                             {"attributes", telemetry::attributesOf(group.info)},
                             {"columns", std::move(columns)}});
  }
  return out;
}

Result<TimeRange> rangeOf(double begin, double end) {
  if (std::isnan(begin) || std::isnan(end)) {
    return failure(ErrorCode::InvalidArgument, "a time must be a number of seconds, not NaN");
  }
  if (begin > end) {
    return failure(ErrorCode::InvalidArgument, "the range ends before it begins");
  }
  // Later than anything that can be recorded; infinite times have no place in a file.
  constexpr double latest = 1e9;
  return TimeRange{std::clamp(begin, -latest, latest), std::clamp(end, -latest, latest)};
}

/// A column that is read.
struct ReadColumn {
  telemetry::Slot slot;
  const Losable* losable = nullptr;  ///< null if its value is always known
};

constexpr auto unknownWord = std::bit_cast<std::uint32_t>(std::numeric_limits<float>::quiet_NaN());
constexpr double unknownValue = std::numeric_limits<double>::quiet_NaN();

Result<std::vector<ReadColumn>> readColumns(const GroupInfo& group,
                                            std::span<const std::int32_t> columns,
                                            std::span<const Losable> losables) {
  const std::vector<telemetry::Slot> places = telemetry::slotsOf(group.columns);
  std::vector<ReadColumn> out;
  for (const std::int32_t column : columns) {
    if (column < 0 || static_cast<std::size_t>(column) >= places.size()) {
      return failure(ErrorCode::NotFound, group.name + " has no column " + std::to_string(column) +
                                              "; it has " + std::to_string(places.size()) +
                                              ", counted from 0");
    }
    const auto c = static_cast<std::uint32_t>(column);
    const auto losable = std::ranges::find(losables, c, &Losable::column);
    out.push_back({places[c], losable == losables.end() ? nullptr : &*losable});
  }
  return out;
}

void appendRow(const RowView& row, std::span<const ReadColumn> columns, DataParts& parts) {
  parts[0].values.push_back(row.time);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto& [slot, losable] = columns[i];
    const bool isUnknown = losable != nullptr && losable->isLost(row);
    if (slot.type == ColumnType::Float64) {
      parts[i + 1].values.push_back(isUnknown ? unknownValue : row.values[slot.index]);
    } else {
      parts[i + 1].words.push_back(isUnknown ? unknownWord : row.words[slot.index]);
    }
  }
}

Result<DataParts> rowsOf(const SessionReader& session, std::int32_t group,
                         std::span<const std::int32_t> columns, TimeRange range, bool keepOld) {
  const auto groups = session.groups();
  if (group < 0 || static_cast<std::size_t>(group) >= groups.size()) {
    return failure(ErrorCode::NotFound, "the session has no group " + std::to_string(group) +
                                            "; it has " + std::to_string(groups.size()) +
                                            ", counted from 0");
  }
  const auto id = static_cast<telemetry::GroupId>(group);
  const GroupInfo& info = groups[id].info;
  const auto losables = keepOld ? std::vector<Losable>() : telemetry::losableColumns(info);
  const std::vector<ReadColumn> chosen = TRY(readColumns(info, columns, losables));
  DataParts parts(columns.size() + 1);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    parts[i + 1].type = typeOf(info.columns[static_cast<std::size_t>(columns[i])]);
  }
  session.rows(range, std::span(&id, 1), [&](telemetry::GroupId, const RowView& row) {
    appendRow(row, chosen, parts);
    return true;
  });
  return parts;
}

double numberOf(const RowView& row, telemetry::Slot slot) {
  switch (slot.type) {
    case ColumnType::Int32:
      return static_cast<double>(std::bit_cast<std::int32_t>(row.words[slot.index]));
    case ColumnType::Float32:
      return static_cast<double>(std::bit_cast<float>(row.words[slot.index]));
    case ColumnType::Float64:
      break;
  }
  return row.values[slot.index];
}

DataParts frameOf(const SessionReader& session, double time) {
  std::vector<telemetry::SessionRow> rows;
  session.rowsAt(time, rows);
  DataParts parts(rows.size());
  for (std::size_t g = 0; g < rows.size(); ++g) {
    const GroupInfo& info = session.groups()[g].info;
    std::vector<double>& out = parts[g].values;
    out.assign(info.columns.size() + 1, unknownValue);
    if (!rows[g].present) continue;
    const RowView row = rows[g].view();
    out[0] = row.time;
    const auto places = telemetry::slotsOf(info.columns);
    for (std::size_t c = 0; c < places.size(); ++c) out[c + 1] = numberOf(row, places[c]);
    for (const Losable& losable : telemetry::losableColumns(info)) {
      if (losable.isLost(row)) out[losable.column + 1] = unknownValue;
    }
  }
  return parts;
}

}  // namespace

pb_status pb_session_open(const char* path, pb_session** session) {
  return guarded([&] {
    if (session == nullptr) return missing("session");
    *session = nullptr;
    if (path == nullptr) return missing("path");
    auto opened = SessionReader::open(path);
    if (!opened) return reportStatus(tl::unexpected(opened.error()));
    *session = sessionHandles().add(std::make_shared<LockedSession>(std::move(*opened)));
    return reportStatus(PB_OK, "");
  });
}

pb_status pb_session_close(pb_session* session) {
  return destroyHandle(sessionHandles(), session, "session");
}

pb_status pb_session_describe(pb_session* session, pb_data** data) {
  return readSession(session, data, [](const SessionReader& reader) -> Result<DataParts> {
    return textParts(jsonText(descriptionOf(reader)));
  });
}

pb_status pb_session_group(pb_session* session, const char* name, std::int32_t* group) {
  return guarded([&] {
    if (name == nullptr) return missing("name");
    if (group == nullptr) return missing("group");
    return withHandle(sessionHandles(), session, "session", [&](const LockedSession& found) {
      const auto groups = found.reader.groupsNamed(name);
      if (!groups) return reportStatus(tl::unexpected(groups.error()));
      *group = static_cast<std::int32_t>(groups->front());
      return reportStatus(PB_OK, "");
    });
  });
}

pb_status pb_session_events(pb_session* session, double begin, double end, pb_data** data) {
  return readSession(session, data, [&](const SessionReader& reader) -> Result<DataParts> {
    const TimeRange range = TRY(rangeOf(begin, end));
    std::string text = "[";
    for (const MatchEvent& event : eventsOf(reader)) {
      if (event.time < range.begin || event.time > range.end) continue;
      if (text.size() > 1) text += ',';
      text += telemetry::sessionEventJson(sessionEvent(event));
    }
    return textParts(text + ']');
  });
}

pb_status pb_session_rows(pb_session* session, std::int32_t group, const std::int32_t* columns,
                          size_t column_count, double begin, double end, std::int32_t unknown,
                          pb_data** data) {
  return readSession(session, data, [&](const SessionReader& reader) -> Result<DataParts> {
    if (columns == nullptr && column_count > 0) {
      return failure(ErrorCode::InvalidArgument, "columns must not be null");
    }
    if (unknown != PB_UNKNOWN_NAN && unknown != PB_UNKNOWN_OLD) {
      return failure(ErrorCode::InvalidArgument,
                     "unknown must be PB_UNKNOWN_NAN or PB_UNKNOWN_OLD");
    }
    const TimeRange range = TRY(rangeOf(begin, end));
    return rowsOf(reader, group, spanOf(columns, column_count), range, unknown == PB_UNKNOWN_OLD);
  });
}

pb_status pb_session_frame(pb_session* session, double time, pb_data** data) {
  return readSession(session, data, [&](const SessionReader& reader) -> Result<DataParts> {
    const TimeRange range = TRY(rangeOf(time, time));
    return frameOf(reader, range.end);
  });
}

pb_status pb_mean_interval(const double* values, size_t count, pb_mean* mean) {
  return guarded([&] {
    if (mean == nullptr) return missing("mean");
    if (mean->size != sizeof(pb_mean)) {
      return reportStatus(PB_INVALID_ARGUMENT,
                          "set size to sizeof(pb_mean) of this version's header before");
    }
    if (values == nullptr && count > 0) return missing("values");
    const telemetry::MeanInterval found = telemetry::intervalOfMean(spanOf(values, count));
    mean->effective = found.effective;
    mean->low = found.low;
    mean->high = found.high;
    return reportStatus(PB_OK, "");
  });
}

pb_status pb_data_span(const pb_data* data, size_t index, pb_span* span) {
  return guarded([&] {
    if (span == nullptr) return missing("span");
    if (span->size != sizeof(pb_span)) {
      return reportStatus(PB_INVALID_ARGUMENT,
                          "set size to sizeof(pb_span) of this version's header before");
    }
    if (data == nullptr) return missing("data");
    const auto found = dataHandles().find(data);
    if (!found) return reportStatus(PB_STALE_HANDLE, "these data were freed before");
    if (index >= found->size()) {
      return reportStatus(PB_NOT_FOUND, "there is no array " + std::to_string(index) + " but " +
                                            std::to_string(found->size()) + ", counted from 0");
    }
    const DataPart& part = (*found)[index];
    span->type = part.type;
    switch (part.type) {
      case PB_CHARS:
        span->values = part.text.c_str();
        span->count = part.text.size();
        break;
      case PB_INT32:
      case PB_FLOAT32:
        span->values = part.words.data();
        span->count = part.words.size();
        break;
      case PB_FLOAT64:
        span->values = part.values.data();
        span->count = part.values.size();
        break;
    }
    return reportStatus(PB_OK, "");
  });
}

pb_status pb_data_free(pb_data* data) {
  return guarded([&] {
    if (data == nullptr || dataHandles().remove(data)) return reportStatus(PB_OK, "");
    return reportStatus(PB_STALE_HANDLE, "these data were freed before");
  });
}
