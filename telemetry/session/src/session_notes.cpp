// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/session/session_notes.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include <base/file_target.h>
#include <base/read_file.h>
#include <base/try.h>
#include <telemetry/wire/lenient_json.h>

namespace pitchboard::telemetry {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t maxNotesBytes = std::size_t{8} << 20, maxNotes = 20'000;

}  // namespace

std::string sessionNotesPath(const std::string& session) {
  return session + ".notes.json";
}

Result<SessionNotes> readSessionNotes(const std::string& session) {
  const std::string path = sessionNotesPath(session);
  const auto bytes = readFile(path, maxNotesBytes, "The file with the bookmarks");
  if (!bytes && bytes.error().code == ErrorCode::NotFound) return SessionNotes{};
  if (!bytes) return tl::unexpected(bytes.error());
  const Json json = lenient::parsed<Json>(*bytes);
  const Json* bookmarks = json.is_object() ? lenient::member(json, "bookmarks") : nullptr;
  if (bookmarks == nullptr || !bookmarks->is_array()) {
    return failure(ErrorCode::ParseError,
                   "This file has no bookmarks that can be read. Repair or remove it.", path);
  }
  SessionNotes notes;
  lenient::each(json, "bookmarks", maxNotes, [&notes](std::size_t, const Json& bookmark) {
    if (!bookmark.is_object()) return;
    const auto time = lenient::number(bookmark, "time");
    if (time && std::isfinite(*time)) notes[*time] = lenient::text(bookmark, "note");
  });
  return notes;
}

Result<void> addSessionNote(const std::string& session, double time, const std::string& note) {
  SessionNotes notes = TRY(readSessionNotes(session));
  notes[time] = note;
  Json json{{"version", 1}, {"bookmarks", Json::array()}};
  for (const auto& [at, text] : notes) json["bookmarks"].push_back({{"time", at}, {"note", text}});
  return writeFile(sessionNotesPath(session),
                   json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n",
                   IfExists::Replace);
}

}  // namespace pitchboard::telemetry
