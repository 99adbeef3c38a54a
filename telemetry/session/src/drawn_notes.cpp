// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/session/drawn_notes.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include <base/csv_field.h>
#include <base/lenient_json.h>
#include <base/try.h>
#include <telemetry/session/session_notes.h>

#include "notes_file.h"

namespace pitchboard::telemetry {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* drawnKey = "drawn";
constexpr double farthest = 1e12;  // of a coordinate; nothing is drawn beyond
constexpr std::array<std::string_view, 3> shapeNames{"text", "arrow", "circle"};
constexpr std::array<std::string_view, 3> placeNames{"field", "plot", "video"};

template <class Value>
std::optional<Value> valueNamed(const std::array<std::string_view, 3>& names,
                                std::string_view name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return {};
  return static_cast<Value>(found - names.begin());
}

std::optional<Point> pointIn(const Json& json, const char* key) {
  const Json* pair = lenient::member(json, key);
  if (pair == nullptr || !pair->is_array() || pair->size() != 2) return {};
  if (!(*pair)[0].is_number() || !(*pair)[1].is_number()) return {};
  const Point point{(*pair)[0].get<double>(), (*pair)[1].get<double>()};
  const auto isNear = [](double value) {
    return std::isfinite(value) && std::abs(value) < farthest;
  };
  return isNear(point.x) && isNear(point.y) ? std::optional(point) : std::nullopt;
}

/// At most so many bytes, without half a letter at the end.
std::string shortened(std::string text) {
  if (text.size() <= DrawnNote::maxText) return text;
  std::size_t end = DrawnNote::maxText;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  text.resize(end);
  return text;
}

std::optional<DrawnNote> noteIn(const Json& json) {
  if (!json.is_object()) return {};
  const auto shape = valueNamed<NoteShape>(shapeNames, lenient::text(json, "shape"));
  const auto place = valueNamed<NotePlace>(placeNames, lenient::text(json, "place"));
  const auto time = lenient::number(json, "time");
  const auto from = pointIn(json, "from");
  if (!shape || !place || !time || !std::isfinite(*time) || !from) return {};
  DrawnNote note;
  note.time = *time;
  const double duration = lenient::number(json, "duration").value_or(DrawnNote::usualDuration);
  if (!std::isfinite(duration)) return {};
  note.duration = std::clamp(duration, DrawnNote::shortestDuration, DrawnNote::longestDuration);
  note.shape = *shape;
  note.place = *place;
  note.on = shortened(lenient::text(json, "on"));
  note.unit = shortened(lenient::text(json, "unit"));
  note.from = *from;
  note.to = pointIn(json, "to").value_or(*from);
  note.text = shortened(lenient::text(json, "text"));
  return note;
}

Json jsonOf(const DrawnNote& note) {
  Json json{{"time", note.time},
            {"duration", note.duration},
            {"shape", nameOf(note.shape)},
            {"place", nameOf(note.place)}};
  if (!note.on.empty()) json["on"] = note.on;
  if (!note.unit.empty()) json["unit"] = note.unit;
  json["from"] = {note.from.x, note.from.y};
  if (note.shape != NoteShape::Text) json["to"] = {note.to.x, note.to.y};
  if (!note.text.empty()) json["text"] = note.text;
  return json;
}

std::string numberText(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

}  // namespace

std::string_view nameOf(NoteShape shape) {
  return shapeNames[static_cast<std::size_t>(shape)];
}

std::string_view nameOf(NotePlace place) {
  return placeNames[static_cast<std::size_t>(place)];
}

std::string labelOf(const DrawnNote& note) {
  if (!note.text.empty()) return note.text;
  return std::string(nameOf(note.shape)) + " on " +
         (note.on.empty() ? "the " + std::string(nameOf(note.place)) : note.on);
}

Result<DrawnNotes> readDrawnNotes(const std::string& session) {
  const Json json = TRY(readNotesFile(session));
  DrawnNotes read;
  const Json* list = lenient::member(json, drawnKey);
  if (list == nullptr) return read;
  if (!list->is_array() || list->size() > DrawnNotes::most) {
    return failure(ErrorCode::ParseError,
                   list->is_array()
                       ? "This file has " + std::to_string(list->size()) +
                             " drawn notes; at most " + std::to_string(DrawnNotes::most) +
                             " can be shown. Remove some of them."
                       : "The drawn notes in this file are not a list. Repair or "
                         "remove \"drawn\".",
                   sessionNotesPath(session));
  }
  for (const Json& one : *list) {
    if (auto note = noteIn(one))
      read.notes.push_back(std::move(*note));
    else
      ++read.unreadable;
  }
  std::ranges::stable_sort(read.notes, {}, &DrawnNote::time);
  return read;
}

Result<void> writeDrawnNotes(const std::string& session, std::span<const DrawnNote> notes) {
  if (notes.size() > DrawnNotes::most) {
    return failure(ErrorCode::InvalidArgument, "A session can have " +
                                                   std::to_string(DrawnNotes::most) +
                                                   " drawn notes. Delete some of them.");
  }
  return changeNotesFile(session, [notes](Json& json) {
    Json list = Json::array();
    for (const DrawnNote& note : notes) list.push_back(jsonOf(note));
    lenient::each(json, drawnKey, DrawnNotes::most, [&list](std::size_t, const Json& one) {
      if (!noteIn(one)) list.push_back(one);
    });
    if (list.empty())
      json.erase(drawnKey);
    else
      json[drawnKey] = std::move(list);
  });
}

Result<void> copyDrawnNotes(const std::string& session, const std::string& part, TimeRange range) {
  if (session.empty()) return {};  // it was read from memory
  auto all = readDrawnNotes(session);
  if (!all) return {};
  std::erase_if(all->notes, [range](const DrawnNote& note) {
    return note.time > range.end || note.time + note.duration < range.begin;
  });
  return writeDrawnNotes(part, all->notes);
}

std::string drawnNotesCsv(std::span<const DrawnNote> notes) {
  std::string out = "time,duration,shape,place,on,unit,x,y,to_x,to_y,text\n";
  for (const DrawnNote& note : notes) {
    out += numberText(note.time) + ',' + numberText(note.duration) + ',' +
           std::string(nameOf(note.shape)) + ',' + std::string(nameOf(note.place)) + ',' +
           csvField(note.on) + ',' + csvField(note.unit) + ',' + numberText(note.from.x) + ',' +
           numberText(note.from.y) + ',' + numberText(note.to.x) + ',' + numberText(note.to.y) +
           ',' + csvField(note.text) + '\n';
  }
  return out;
}

std::string drawnNotesJson(std::span<const DrawnNote> notes) {
  Json list = Json::array();
  for (const DrawnNote& note : notes) list.push_back(jsonOf(note));
  return list.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace pitchboard::telemetry
