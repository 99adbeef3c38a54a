// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/library/session_index.h>

#include <sys/stat.h>
#include <nlohmann/json.hpp>

#include <base/file_target.h>
#include <base/lenient_json.h>
#include <base/read_file.h>
#include <telemetry/session/session_notes.h>

namespace pitchboard::link {
namespace {

namespace lenient = lenient;
using Json = nlohmann::ordered_json;

constexpr std::string_view heading = R"({"pitchboard":"library","version":1})";
constexpr std::size_t maxIndexBytes = std::size_t{256} << 20;

std::int64_t changeOf(const struct stat& file) {
  return std::int64_t{file.st_mtim.tv_sec} * 1'000'000'000 + file.st_mtim.tv_nsec;
}

std::string lineOf(const IndexedSession& session) {
  const Json key{{"file", session.path},
                 {"bytes", session.stamp.bytes},
                 {"changed", session.stamp.changed},
                 {"notes_changed", session.stamp.notesChanged}};
  std::string line = key.dump(-1, ' ', false, Json::error_handler_t::replace);
  line.back() = ',';  // the object goes on
  return line + overviewJson(session.overview).substr(1) + '\n';
}

std::optional<IndexedSession> sessionIn(std::string_view line) {
  auto overview = overviewFromJson(line);
  if (!overview) return {};
  const Json json = lenient::parsed<Json>(line);
  IndexedSession session{
      lenient::text(json, "file"),
      {lenient::whole<std::uint64_t>(json, "bytes"), lenient::whole<std::int64_t>(json, "changed"),
       lenient::whole<std::int64_t>(json, "notes_changed")},
      std::move(*overview)};
  if (session.path.empty()) return {};
  return session;
}

}  // namespace

std::optional<RecordingStamp> stampOf(const std::string& path) {
  struct stat file {};
  if (::stat(path.c_str(), &file) != 0) return {};
  RecordingStamp stamp{static_cast<std::uint64_t>(file.st_size), changeOf(file), 0};
  struct stat notes {};
  if (::stat(telemetry::sessionNotesPath(path).c_str(), &notes) == 0) {
    stamp.notesChanged = changeOf(notes);
  }
  return stamp;
}

std::vector<IndexedSession> readSessionIndex(const std::string& path) {
  const auto bytes = readFile(path, maxIndexBytes);
  if (!bytes) return {};
  std::vector<IndexedSession> sessions;
  std::string_view rest = *bytes;
  bool isFirst = true;
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    if (isFirst && line != heading) return {};
    if (!isFirst) {
      if (auto session = sessionIn(line)) sessions.push_back(std::move(*session));
    }
    isFirst = false;
  }
  return sessions;
}

Result<void> writeSessionIndex(const std::string& path, std::span<const IndexedSession> sessions) {
  std::string text = std::string(heading) + '\n';
  for (const IndexedSession& session : sessions) text += lineOf(session);
  return writeFile(path, text, IfExists::Replace);
}

}  // namespace pitchboard::link
