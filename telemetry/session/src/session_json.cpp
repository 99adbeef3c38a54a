// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of a session that are JSON: groups, events, log lines, datagrams, and their schemas.

#include <zlib.h>
#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <utility>

#include <base/base64.h>
#include <base/lenient_json.h>
#include <telemetry/formats/meanings.h>
#include <telemetry/series/group_attributes.h>

#include "session_format.h"

namespace pitchboard::telemetry::session {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 3> typeNames{"int32", "float32", "float64"};
constexpr std::array<const char*, 4> kindNames{"number", "flag", "enumeration", "text"};
// Of a typed event this is always there; events before 0.2 have none.
constexpr const char* typedEventKey = "detail";

std::string dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json parse(std::string_view text) {
  return lenient::parsed<Json>(text, 16);
}

template <class Names>
std::optional<std::uint8_t> place(const Names& names, const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_string()) return std::nullopt;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (found->template get_ref<const std::string&>() == names[i]) {
      return static_cast<std::uint8_t>(i);
    }
  }
  return std::nullopt;
}

using lenient::number;
using lenient::text;

std::optional<int> asWhole(const Json& value) {
  if (!value.is_number_integer()) return std::nullopt;
  const auto number = value.get<std::int64_t>();
  return std::in_range<int>(number) ? std::optional(static_cast<int>(number)) : std::nullopt;
}

std::optional<int> wholeNumber(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() ? std::nullopt : asWhole(*found);
}

template <class T>
std::optional<T> whole(std::string_view digits) {
  T value{};
  const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (digits.empty() || code != std::errc() || end != digits.data() + digits.size()) {
    return std::nullopt;
  }
  return value;
}

bool isUtf8(std::string_view bytes) {
  return Json::accept("\"" + [&] {
    std::string safe;
    for (const char c : bytes)
      safe += c == '"' || c == '\\' || static_cast<unsigned char>(c) < 32 ? ' ' : c;
    return safe;
  }() + "\"");
}

std::optional<Json> objectWithTime(std::string_view text) {
  Json json = parse(text);
  if (!json.is_object() || !number(json, "time")) return std::nullopt;
  return json;
}

}  // namespace

const std::array<StreamInfo, sessionStreamCount> streams{
    {
        {"/events", "pitchboard.Event",
         R"({"type":"object","title":"pitchboard.Event","properties":{"time":{"type":"number","description":"seconds of the source"},"kind":{"type":"string"},"group":{"type":"string","description":"name of the robot"},"text":{"type":"string","description":"for people"},"uid":{"type":"integer","description":"identifies the robot in this session"},"side":{"type":"string","description":"left, right"},"team":{"type":"integer"},"colour":{"type":"string"},"team_name":{"type":"string"},"value":{"type":"integer"},"score":{"type":"array","items":{"type":"integer"}},"process":{"type":"string"},"detail":{"type":"string"}},"required":["time","kind"]})"},
        // The fields of foxglove.Log, so that Foxglove's and Lichtblick's log panels show it.
        {"/log", "foxglove.Log",
         R"({"type":"object","title":"foxglove.Log","properties":{"timestamp":{"type":"object","title":"time","properties":{"sec":{"type":"integer"},"nsec":{"type":"integer"}}},"level":{"type":"integer","description":"1 debug, 2 info, 3 warning, 4 error"},"message":{"type":"string"},"name":{"type":"string"},"file":{"type":"string"},"line":{"type":"integer"},"time":{"type":"number","description":"seconds of the source"}},"required":["time","message"]})"},
        {"/telemetry", "pitchboard.Datagram",
         R"({"type":"object","title":"pitchboard.Datagram","properties":{"time":{"type":"number","description":"seconds of the source"},"sender":{"type":"string","description":"address:port"},"port":{"type":"integer","description":"port at which it was received"},"text":{"type":"string"},"base64":{"type":"string","contentEncoding":"base64","description":"the bytes, where they are not UTF-8 text"}},"required":["time","sender","port"]})"},
        {"/referee/raw", "pitchboard.RefereeDatagram", R"({"type":"object","title":"pitchboard.RefereeDatagram","properties":{"time":{"type":"number","description":"seconds of the source"},"sender":{"type":"string","description":"address:port"},"port":{"type":"integer"},"text":{"type":"string"},"base64":{"type":"string","contentEncoding":"base64"}},"required":["time","sender","port"]})"},
        {"/referee", "pitchboard.Referee",
         R"({"type":"object","title":"pitchboard.Referee","properties":{"time":{"type":"number","description":"seconds of the source"}},"required":["time"]})"},
        {"/checkpoints", "pitchboard.Checkpoint",
         R"({"type":"object","title":"pitchboard.Checkpoint","properties":{"time":{"type":"number","description":"seconds of the source"},"tick":{"type":"integer","description":"of the state that it begins with"},"last_tick":{"type":"integer"},"segment":{"type":"string","contentEncoding":"base64","description":"exact state and the commands of the ticks that follow, see docs/file-formats.md"}},"required":["time"]})"},
        {"/live/state", "pitchboard.LiveState",
         R"({"type":"object","title":"pitchboard.LiveState","properties":{"time":{"type":"number","description":"seconds of the source"}},"required":["time"]})"},
    }};

std::optional<SessionStream> streamOf(const McapChannel& channel) {
  const auto found =
      std::ranges::find(streams, std::string_view(channel.topic), &StreamInfo::topic);
  if (found == streams.end() || channel.messageEncoding != "json") return std::nullopt;
  return static_cast<SessionStream>(found - streams.begin());
}

/// MCAP's metadata have no checksum of their own, and a wrong digit in the start would move all
/// times.
std::string checkOf(const McapMap& metadata) {
  unsigned long crc = 0;
  for (const auto& [key, value] : metadata) {
    if (key == checkKey) continue;
    for (const std::string* text : {&key, &value}) {
      crc = crc32_z(crc, reinterpret_cast<const Bytef*>(text->c_str()), text->size() + 1);
    }
  }
  return std::to_string(crc);
}

McapMap toMetadata(const SessionInfo& info) {
  McapMap out;
  for (const auto& [key, value] : info.more) out.insert_or_assign("more." + key, value);
  out.insert_or_assign("format", std::to_string(sessionFormat));
  out.insert_or_assign("program", info.program);
  out.insert_or_assign("source", info.source);
  out.insert_or_assign("title", info.title);
  if (info.seed) out.insert_or_assign("seed", std::to_string(*info.seed));
  out.insert_or_assign("start_ns", std::to_string(info.start.time_since_epoch().count()));
  out.insert_or_assign("created_ns", std::to_string(info.created.time_since_epoch().count()));
  out.insert_or_assign(std::string(checkKey), checkOf(out));
  return out;
}

std::optional<SessionInfo> infoFromMetadata(const McapMap& metadata, int& format) {
  const auto check = metadata.find(checkKey);
  if (check == metadata.end() || check->second != checkOf(metadata)) return std::nullopt;
  const auto value = [&](std::string_view key) {
    const auto found = metadata.find(key);
    return found == metadata.end() ? std::string() : found->second;
  };
  const auto time = [&](std::string_view key) {
    return WallTime(Duration(whole<std::int64_t>(value(key)).value_or(0)));
  };
  SessionInfo info;
  format = whole<int>(value("format")).value_or(0);
  info.program = value("program");
  info.source = value("source");
  info.title = value("title");
  info.seed = whole<std::uint64_t>(value("seed"));
  info.start = time("start_ns");
  info.created = time("created_ns");
  constexpr std::string_view more = "more.";
  for (const auto& [key, text] : metadata) {
    if (key.starts_with(more)) info.more.insert_or_assign(key.substr(more.size()), text);
  }
  return info;
}

std::string groupToJson(const GroupInfo& group) {
  Json columns = Json::array();
  const std::vector<std::string> fields = fieldNames(group);
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const ColumnInfo& column = group.columns[i];
    Json json{{"name", column.name},
              {"field", fields[i]},
              {"type", typeNames[static_cast<std::size_t>(column.type)]}};
    if (!column.unit.empty()) json["unit"] = column.unit;
    if (!column.category.empty()) json["category"] = column.category;
    if (column.kind != ColumnKind::Number) {
      json["kind"] = kindNames[static_cast<std::size_t>(column.kind)];
    }
    if (isSingle(column)) json["resolution"] = column.resolution;
    for (const LostWhen& when : column.lost) {
      json["lost"].push_back({{"column", when.column}, {"value", when.value}});
    }
    for (const auto& [code, label] : column.labels) json["labels"][std::to_string(code)] = label;
    columns.push_back(std::move(json));
  }
  Json json{{"name", group.name}, {"attributes", attributesOf(group)}};
  if (!group.id.empty()) json["id"] = group.id;
  json["columns"] = std::move(columns);
  return dump(json);
}

McapMap toMetadata(const std::string& id, const GroupFacts& facts) {
  constexpr std::string_view attribute = "attribute.";
  McapMap out{{"id", id}, {"name", facts.name}};
  GroupInfo group;
  group.robot = facts.robot;
  group.match = facts.match;
  for (const auto& [key, value] : attributesOf(group)) {
    out.insert_or_assign(std::string(attribute) + key, value);
  }
  out.insert_or_assign(std::string(checkKey), checkOf(out));
  return out;
}

std::optional<std::pair<std::string, GroupFacts>> factsFromMetadata(const McapMap& metadata) {
  constexpr std::string_view attribute = "attribute.";
  const auto check = metadata.find(checkKey);
  const auto id = metadata.find("id"), name = metadata.find("name");
  if (check == metadata.end() || id == metadata.end() || name == metadata.end() ||
      name->second.empty() || check->second != checkOf(metadata)) {
    return std::nullopt;
  }
  GroupAttributes attributes;
  for (const auto& [key, value] : metadata) {
    if (key.starts_with(attribute)) attributes[key.substr(attribute.size())] = value;
  }
  GroupInfo group;
  readAttributes(attributes, group);
  return std::pair(id->second,
                   GroupFacts{name->second, std::move(group.robot), std::move(group.match)});
}

std::optional<GroupInfo> groupFromJson(std::string_view text_) {
  const Json json = parse(text_);
  if (!json.is_object()) return std::nullopt;
  GroupInfo group;
  group.name = text(json, "name");
  if (group.name.empty()) return std::nullopt;
  group.id = text(json, "id");
  if (const auto found = json.find("attributes"); found != json.end() && found->is_object()) {
    GroupAttributes attributes;
    for (const auto& [key, value] : found->items()) {
      if (value.is_string()) attributes[key] = value.get<std::string>();
    }
    readAttributes(attributes, group);
  }
  // Version 0.8 called the columns of the published profile otherwise, and others' never so.
  const std::string& profile = factsOf(group).profile;
  const bool isOldLive = factsOf(group).live && (profile.empty() || profile == "published");
  const auto columns = json.find("columns");
  if (columns == json.end() || !columns->is_array()) return std::nullopt;
  for (const Json& entry : *columns) {
    if (!entry.is_object()) return std::nullopt;
    const auto type = place(typeNames, entry, "type");
    ColumnInfo column;
    column.name = text(entry, "name");
    if (!type || column.name.empty()) return std::nullopt;
    column.type = static_cast<ColumnType>(*type);
    if (column.type != ColumnType::Float64 && !group.columns.empty() &&
        group.columns.back().type == ColumnType::Float64) {
      return std::nullopt;
    }
    if (entry.contains("resolution")) {
      column.resolution = number(entry, "resolution").value_or(0.0);
      if (!isSingle(column)) return std::nullopt;
    }
    column.unit = text(entry, "unit");
    if (const auto lost = entry.find("lost"); lost != entry.end() && lost->is_array()) {
      for (const Json& when : *lost) {
        if (!when.is_object()) return std::nullopt;
        column.lost.push_back({text(when, "column"), number(when, "value").value_or(0.0)});
      }
    } else if (entry.contains("lost_by")) {  // version 0.16 and earlier: one condition
      column.lost.push_back({text(entry, "lost_by"), number(entry, "lost_when").value_or(0.0)});
    }
    // Files of version 0.1 call it "heading".
    column.category = text(entry, entry.contains("category") ? "category" : "heading");
    const auto isIt = [&column](const MeaningInfo& known) {
      return known.oldName == column.name && known.unit == column.unit &&
             known.category == column.category;
    };
    if (isOldLive && std::ranges::any_of(meaningTable, isIt))
      column.name = presentName(column.name);
    column.kind = static_cast<ColumnKind>(place(kindNames, entry, "kind").value_or(0));
    if (const auto labels = entry.find("labels"); labels != entry.end() && labels->is_object()) {
      for (const auto& [code, label] : labels->items()) {
        const auto value = whole<std::int32_t>(code);
        if (value && label.is_string()) column.labels[*value] = label.get<std::string>();
      }
    }
    group.columns.push_back(std::move(column));
  }
  return group;
}

std::string toJson(const SessionEvent& event) {
  Json json{
      {"time", event.time}, {"kind", event.kind}, {"group", event.group}, {"text", event.text}};
  if (!event.facts) return dump(json);
  const EventFacts& facts = *event.facts;
  if (facts.robot != RobotUid{}) json["uid"] = facts.robot.value;
  if (!facts.side.empty()) json["side"] = facts.side;
  if (facts.team != 0) json["team"] = facts.team;
  if (!facts.colour.empty()) json["colour"] = facts.colour;
  if (!facts.teamName.empty()) json["team_name"] = facts.teamName;
  if (facts.value) json["value"] = *facts.value;
  if (facts.score) json["score"] = {facts.score->first, facts.score->second};
  if (!facts.process.empty()) json["process"] = facts.process;
  if (facts.cause != 0) json["cause"] = facts.cause;
  json[typedEventKey] = facts.detail;
  return dump(json);
}

std::string toJson(const LogLine& line, std::uint64_t wallNanoseconds) {
  return dump(
      Json{{"timestamp",
            {{"sec", wallNanoseconds / 1'000'000'000}, {"nsec", wallNanoseconds % 1'000'000'000}}},
           {"level", static_cast<int>(line.level)},
           {"message", line.text},
           {"name", line.origin},
           {"file", ""},
           {"line", 0},
           {"time", line.time}});
}

std::string toJson(const SessionDatagram& datagram) {
  Json json{
      {"time", datagram.time}, {"sender", datagram.sender.text()}, {"port", datagram.localPort}};
  if (isUtf8(datagram.payload))
    json["text"] = datagram.payload;
  else
    json["base64"] = toBase64(datagram.payload);
  return dump(json);
}

std::optional<SessionEvent> eventFromJson(std::string_view json) {
  const auto object = objectWithTime(json);
  if (!object) return std::nullopt;
  SessionEvent event{*number(*object, "time"), text(*object, "kind"), text(*object, "group"),
                     text(*object, "text")};
  if (!object->contains(typedEventKey)) return event;
  EventFacts& facts = event.facts.emplace();
  facts.robot.value = lenient::whole<std::uint32_t>(*object, "uid");
  facts.side = text(*object, "side");
  facts.team = wholeNumber(*object, "team").value_or(0);
  facts.colour = text(*object, "colour");
  facts.teamName = text(*object, "team_name");
  facts.value = wholeNumber(*object, "value");
  if (const auto score = object->find("score");
      score != object->end() && score->is_array() && score->size() == 2) {
    const auto left = asWhole((*score)[0]), right = asWhole((*score)[1]);
    if (left && right) facts.score.emplace(*left, *right);
  }
  facts.process = text(*object, "process");
  facts.detail = text(*object, typedEventKey);
  facts.cause = wholeNumber(*object, "cause").value_or(0);
  return event;
}

std::optional<LogLine> logLineFromJson(std::string_view json) {
  const auto object = objectWithTime(json);
  if (!object) return std::nullopt;
  return LogLine{*number(*object, "time"), text(*object, "name"), text(*object, "message"),
                 static_cast<LogLevel>(std::clamp(number(*object, "level").value_or(2), 0.0, 5.0))};
}

std::optional<SessionDatagram> datagramFromJson(std::string_view json) {
  const auto object = objectWithTime(json);
  if (!object) return std::nullopt;
  SessionDatagram out;
  out.time = *number(*object, "time");
  const std::string sender = text(*object, "sender");
  const auto colon = std::min(sender.rfind(':'), sender.size());
  const auto address = parseAddress(sender.substr(0, colon));
  const auto port = colon == sender.size()
                        ? std::uint16_t{0}
                        : whole<std::uint16_t>(std::string_view(sender).substr(colon + 1));
  if (!address || !port) return std::nullopt;
  out.sender = {*address, *port};
  out.localPort =
      static_cast<std::uint16_t>(std::clamp(number(*object, "port").value_or(0.0), 0.0, 65535.0));
  if (object->contains("base64")) {
    auto bytes = fromBase64(text(*object, "base64"));
    if (!bytes) return std::nullopt;
    out.payload = std::move(*bytes);
  } else {
    out.payload = text(*object, "text");
  }
  return out;
}

std::optional<double> timeFromJson(std::string_view json) {
  const auto object = objectWithTime(json);
  return object ? number(*object, "time") : std::nullopt;
}

}  // namespace pitchboard::telemetry::session
