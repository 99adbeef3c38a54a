// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/session/session_notes.h>

#include <cmath>
#include <filesystem>
#include <mutex>
#include <optional>

#include <base/file_target.h>
#include <base/lenient_json.h>
#include <base/read_file.h>
#include <base/try.h>
#include <telemetry/session/session_videos.h>

#include "notes_file.h"

namespace pitchboard::telemetry {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t maxNotesBytes = std::size_t{8} << 20, maxNotes = 20'000, maxVideos = 64,
                      maxAnchors = 2, maxLandmarks = 4;

SessionNotes notesIn(const Json& json) {
  SessionNotes notes;
  lenient::each(json, "bookmarks", maxNotes, [&notes](std::size_t, const Json& bookmark) {
    if (!bookmark.is_object()) return;
    const auto time = lenient::number(bookmark, "time");
    if (time && std::isfinite(*time)) notes[*time] = lenient::text(bookmark, "note");
  });
  return notes;
}

fs::path folderOf(const std::string& session) {
  return fs::absolute(fs::path(session)).parent_path();
}

/// The file where it is now: moved together with the session, beside it, or where it was.
std::string foundVideo(const fs::path& folder, const Json& video) {
  const fs::path relative = lenient::text(video, "file"), was = lenient::text(video, "was");
  std::error_code ignored;
  for (const fs::path& path : {folder / relative, folder / relative.filename(), was}) {
    if (!relative.empty() && fs::is_regular_file(path, ignored)) {
      return path.lexically_normal().string();
    }
  }
  return (folder / relative).lexically_normal().string();
}

/// Two numbers of an object; nothing unless both are there.
std::optional<std::pair<double, double>> numberPair(const Json& object, const char* first,
                                                    const char* second) {
  if (!object.is_object()) return {};
  const auto a = lenient::number(object, first), b = lenient::number(object, second);
  if (!a || !b || !std::isfinite(*a) || !std::isfinite(*b)) return {};
  return std::pair(*a, *b);
}

SessionVideo videoIn(const fs::path& folder, const Json& json) {
  SessionVideo video{foundVideo(folder, json), {}, {}};
  lenient::each(json, "moments", maxAnchors, [&video](std::size_t, const Json& moment) {
    if (const auto both = numberPair(moment, "session", "video")) {
      video.anchors.push_back({both->first, both->second});
    }
  });
  lenient::each(json, "points", maxLandmarks, [&video](std::size_t, const Json& point) {
    const auto field = numberPair(point, "field_x", "field_y"),
               picture = numberPair(point, "x", "y");
    if (field && picture) {
      video.landmarks.push_back({{field->first, field->second}, {picture->first, picture->second}});
    }
  });
  return video;
}

Json jsonOf(const fs::path& folder, const SessionVideo& video) {
  const fs::path path = fs::absolute(video.path).lexically_normal();
  const fs::path relative = path.lexically_relative(folder.lexically_normal());
  Json json{{"file", (relative.empty() ? path : relative).string()},
            {"was", path.string()},
            {"moments", Json::array()},
            {"points", Json::array()}};
  for (const VideoAnchor& anchor : video.anchors) {
    json["moments"].push_back({{"session", anchor.session}, {"video", anchor.video}});
  }
  for (const VideoLandmark& mark : video.landmarks) {
    json["points"].push_back({{"field_x", mark.field.x},
                              {"field_y", mark.field.y},
                              {"x", mark.picture.x},
                              {"y", mark.picture.y}});
  }
  return json;
}

}  // namespace

Result<Json> readNotesFile(const std::string& session) {
  const std::string path = sessionNotesPath(session);
  const auto bytes = readFile(path, maxNotesBytes, "The file with the notes");
  if (!bytes && bytes.error().code == ErrorCode::NotFound) {
    return Json{{"version", 1}, {"bookmarks", Json::array()}};
  }
  if (!bytes) return tl::unexpected(bytes.error());
  Json json = lenient::parsed<Json>(*bytes);
  const Json* bookmarks = json.is_object() ? lenient::member(json, "bookmarks") : nullptr;
  if (bookmarks == nullptr || !bookmarks->is_array()) {
    return failure(ErrorCode::ParseError,
                   "This file has no bookmarks that can be read. Repair or remove it.", path);
  }
  return json;
}

Result<void> changeNotesFile(const std::string& session, const std::function<void(Json&)>& change) {
  static std::mutex oneAtATime;
  const std::lock_guard lock(oneAtATime);
  const Json before = TRY(readNotesFile(session));
  Json after = before;
  change(after);
  if (after == before) return {};
  return writeFile(sessionNotesPath(session),
                   after.dump(2, ' ', false, Json::error_handler_t::replace) + "\n",
                   IfExists::Replace);
}

std::string sessionNotesPath(const std::string& session) {
  return session + ".notes.json";
}

Result<SessionNotes> readSessionNotes(const std::string& session) {
  return notesIn(TRY(readNotesFile(session)));
}

Result<void> addSessionNote(const std::string& session, double time, const std::string& note) {
  return changeNotesFile(session, [&](Json& json) {
    SessionNotes notes = notesIn(json);
    notes[time] = note;
    Json& bookmarks = json["bookmarks"] = Json::array();
    for (const auto& [at, text] : notes) bookmarks.push_back({{"time", at}, {"note", text}});
  });
}

Result<VideoAlignment> alignmentOf(std::span<const VideoAnchor> anchors) {
  if (anchors.empty()) return VideoAlignment{};
  const VideoAnchor& first = anchors.front();
  if (anchors.size() == 1) return VideoAlignment{first.session - first.video, 1.0};
  const VideoAnchor& second = anchors[1];
  constexpr double fastest = 100.0;  // slow motion of 3000 pictures a second
  const double rate = (second.session - first.session) / (second.video - first.video);
  if (!(rate > 1.0 / fastest && rate < fastest)) {
    return failure(ErrorCode::InvalidArgument,
                   "The two moments contradict each other: they must be two different pictures, "
                   "in the same order as in the session. Choose another picture or moment.");
  }
  return VideoAlignment{first.session - rate * first.video, rate};
}

Result<std::vector<SessionVideo>> readSessionVideos(const std::string& session) {
  const Json json = TRY(readNotesFile(session));
  std::vector<SessionVideo> videos;
  lenient::each(json, "videos", maxVideos, [&](std::size_t, const Json& video) {
    if (video.is_object() && !lenient::text(video, "file").empty()) {
      videos.push_back(videoIn(folderOf(session), video));
    }
  });
  return videos;
}

Result<void> writeSessionVideos(const std::string& session, std::span<const SessionVideo> videos) {
  return changeNotesFile(session, [&](Json& json) {
    Json& list = json["videos"] = Json::array();
    for (const SessionVideo& video : videos) list.push_back(jsonOf(folderOf(session), video));
  });
}

}  // namespace pitchboard::telemetry
