// SPDX-License-Identifier: GPL-3.0-or-later
// rosbag2's sqlite3 files (storage plugin "sqlite3"). Since its schema 4 they hold the definitions
// of the messages; for older ones *.msg files are looked up beside the recording, as
// PACKAGE/msg/NAME.msg.
#include <sqlite3.h>
#include <algorithm>
#include <filesystem>
#include <limits>
#include <queue>
#include <set>

#include <base/byte_sizes.h>
#include <base/read_file.h>
#include <base/try.h>
#include <telemetry/recordings/decoded_topics.h>

#include "recording_formats.h"

namespace pitchboard::telemetry {
namespace {

constexpr int maxDatabaseValue = 64 << 20;
constexpr std::size_t maxDefinitionFiles = 500;

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Database = std::unique_ptr<sqlite3, CloseDatabase>;
using Statement = std::unique_ptr<sqlite3_stmt, CloseDatabase>;

std::string_view textAt(sqlite3_stmt* row, int column) {
  const auto* bytes = static_cast<const char*>(sqlite3_column_blob(row, column));
  const int size = sqlite3_column_bytes(row, column);
  return bytes == nullptr ? std::string_view()
                          : std::string_view(bytes, static_cast<std::size_t>(size));
}

Error databaseError(sqlite3* database, const std::string& path) {
  return {ErrorCode::ParseError,
          std::string("The database cannot be read: ") + sqlite3_errmsg(database) + ".", path};
}

/// Returns the URI of a database. Without a write-ahead log beside it, it is opened as immutable:
/// otherwise SQLite leaves files beside a recording in WAL mode, and fails in a folder that is only
/// readable (https://www.sqlite.org/wal.html#readonly).
std::string databaseUri(const std::string& path) {
  std::error_code ignored;
  std::string uri = "file://";
  for (const char c : std::filesystem::absolute(path, ignored).string()) {
    constexpr std::string_view digits = "0123456789ABCDEF";
    const auto byte = static_cast<unsigned char>(c);
    if (c == '%' || c == '?' || c == '#') {
      uri += {'%', digits[byte >> 4], digits[byte & 15]};
    } else {
      uri += c;
    }
  }
  return std::filesystem::exists(path + "-wal", ignored) ? uri : uri + "?immutable=1";
}

/// The definitions of a type and of all that it uses, from files beside the recording, as one
/// ros2msg text. Empty if the file of the type is not there.
class DefinitionsBeside {
 public:
  explicit DefinitionsBeside(const std::string& recording)
      : m_folder(std::filesystem::path(recording).parent_path()) {}

  std::string of(const std::string& type) {
    std::string text = readType(type);
    std::vector<std::string> due = typesIn(type, text);
    std::set<std::string> taken{type};
    while (!text.empty() && !due.empty() && taken.size() < maxDefinitionFiles) {
      const std::string name = std::move(due.back());
      due.pop_back();
      if (!taken.insert(name).second) continue;
      const std::string part = readType(name);
      if (part.empty()) continue;
      text += "\n" + std::string(80, '=') + "\nMSG: " + name + "\n" + part;
      for (std::string& one : typesIn(name, part)) due.push_back(std::move(one));
    }
    return text;
  }

 private:
  std::string readType(const std::string& type) const {
    const auto slash = type.find('/');
    if (slash == type.npos || type.find("..") != type.npos) return {};
    const std::filesystem::path folder = m_folder / type.substr(0, slash);
    const std::string name = type.substr(slash + 1) + ".msg";
    for (const auto& path : {folder / "msg" / name, folder / name}) {
      std::error_code problem;
      if (!std::filesystem::is_regular_file(path, problem)) continue;
      if (auto text = readFile(path.string(), mebibyte, "The definition")) return *text;
    }
    return {};
  }

  /// Everything that may be the name of a type; what is none has no file.
  static std::vector<std::string> typesIn(const std::string& of, std::string_view text) {
    std::vector<std::string> types;
    while (!text.empty()) {
      const auto end = text.find('\n');
      std::string_view line = text.substr(0, end);
      text.remove_prefix(end == text.npos ? text.size() : end + 1);
      const auto begin = line.find_first_not_of(" \t\r");
      if (begin == line.npos) continue;
      line = line.substr(begin);
      const std::string type(line.substr(0, line.find_first_of(" \t[<#")));
      if (type.empty() || types.size() > 1000) continue;
      types.push_back(type.find('/') != type.npos ? shortType(type)
                                                  : of.substr(0, of.find('/') + 1) + type);
    }
    return types;
  }

  std::filesystem::path m_folder;
};

class Rosbag2Recording : public RecordingReader {
 public:
  Result<void> add(const std::string& path) {
    sqlite3* opened = nullptr;
    const int code =
        sqlite3_open_v2(databaseUri(path).c_str(), &opened,
                        SQLITE_OPEN_READONLY | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_URI, nullptr);
    File file{path, Database(opened), {}, {}};
    if (code != SQLITE_OK) return tl::unexpected(databaseError(opened, path));
    // The file may be made to harm.
    sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, maxDatabaseValue);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    TRY(checkTables(file));
    TRY(takeTopics(file));
    // In the order of the index, else of the rows: sorting millions of messages takes memory.
    file.messages = TRY(prepare(file,
                                "SELECT topic_id, timestamp, data FROM messages "
                                "ORDER BY timestamp"));
    m_total += std::max<std::uint64_t>(1, countOf(file));
    m_files.push_back(std::move(file));
    return {};
  }

  const std::vector<RecordedTopic>& topics() const override { return m_topics.topics(); }
  double progress() const override {
    return std::min(1.0, static_cast<double>(m_read) / static_cast<double>(m_total));
  }

  Result<RecordedItem> next() override {
    if (!m_began) {
      m_began = true;
      for (std::size_t i = 0; i < m_files.size(); ++i) step(i);
    } else if (m_current) {
      step(*m_current);
      m_current.reset();
    }
    while (!m_heads.empty()) {
      const std::size_t file = m_heads.top().second;
      m_heads.pop();
      m_current = file;
      if (take(file)) return RecordedItem::Message;
      step(file);
      m_current.reset();
    }
    return RecordedItem::End;
  }

  std::vector<std::string> notes() const override {
    std::vector<std::string> notes = m_damage;
    m_topics.addNotes(notes);
    if (m_unknown > 0) {
      notes.push_back(countText(m_unknown, "message belongs", "messages belong") +
                      " to topics that the recording does not define.");
    }
    return notes;
  }

 private:
  struct File {
    std::string path;
    Database database;
    Statement messages;
    std::map<std::int64_t, std::size_t> topicOfId;
  };
  using HeadTime = std::pair<std::int64_t, std::size_t>;

  static Result<Statement> prepare(const File& file, const char* sql) {
    sqlite3_stmt* made = nullptr;
    if (sqlite3_prepare_v2(file.database.get(), sql, -1, &made, nullptr) != SQLITE_OK) {
      return tl::unexpected(databaseError(file.database.get(), file.path));
    }
    return Statement(made);
  }

  /// A view could be anything, and never end.
  static Result<void> checkTables(const File& file) {
    const auto tables = TRY(prepare(file,
                                    "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND "
                                    "name IN ('messages', 'topics')"));
    if (sqlite3_step(tables.get()) == SQLITE_ROW && sqlite3_column_int(tables.get(), 0) == 2) {
      return {};
    }
    return failure(ErrorCode::ParseError,
                   "This is not a recording of rosbag2: it has no tables \"topics\" and "
                   "\"messages\".",
                   file.path);
  }

  static std::uint64_t countOf(const File& file) {
    const auto count = prepare(file, "SELECT count(*) FROM messages");
    if (!count || sqlite3_step(count->get()) != SQLITE_ROW) return 1;
    return static_cast<std::uint64_t>(
        std::max<sqlite3_int64>(1, sqlite3_column_int64(count->get(), 0)));
  }

  static std::map<std::string, std::pair<std::string, std::string>> definitionsOf(
      const File& file) {
    std::map<std::string, std::pair<std::string, std::string>> found;
    const auto rows = prepare(file,
                              "SELECT topic_type, encoding, encoded_message_definition FROM "
                              "message_definitions");
    while (rows && sqlite3_step(rows->get()) == SQLITE_ROW && found.size() < 10'000) {
      found[std::string(textAt(rows->get(), 0))] = {std::string(textAt(rows->get(), 1)),
                                                    std::string(textAt(rows->get(), 2))};
    }
    return found;
  }

  Result<void> takeTopics(File& file) {
    const auto definitions = definitionsOf(file);
    DefinitionsBeside beside(file.path);
    const auto rows = TRY(prepare(file, "SELECT id, name, type, serialization_format FROM topics"));
    int code = 0;
    while ((code = sqlite3_step(rows.get())) == SQLITE_ROW && file.topicOfId.size() < 100'000) {
      const std::string type(textAt(rows.get(), 2));
      const auto known = definitions.find(type);
      std::string encoding = "ros2msg", text;
      if (known != definitions.end() && !known->second.second.empty()) {
        std::tie(encoding, text) = known->second;
      } else {
        text = beside.of(shortType(type));
        if (text.empty()) encoding.clear();
      }
      const MessageSchema schema{type, encoding, textAt(rows.get(), 3), text};
      file.topicOfId[sqlite3_column_int64(rows.get(), 0)] =
          m_topics.add(textAt(rows.get(), 1), schema, 0);
    }
    if (code != SQLITE_DONE && code != SQLITE_ROW) {
      return tl::unexpected(databaseError(file.database.get(), file.path));
    }
    return {};
  }

  void step(std::size_t index) {
    File& file = m_files[index];
    ++m_read;
    const int code = sqlite3_step(file.messages.get());
    if (code == SQLITE_ROW) {
      m_heads.push({sqlite3_column_int64(file.messages.get(), 1), index});
    } else if (code != SQLITE_DONE) {
      m_damage.push_back(databaseError(file.database.get(), file.path).text() +
                         " Later messages are missing.");
    }
  }

  bool take(std::size_t index) {
    const File& file = m_files[index];
    sqlite3_stmt* row = file.messages.get();
    const auto topic = file.topicOfId.find(sqlite3_column_int64(row, 0));
    if (topic == file.topicOfId.end()) {
      ++m_unknown;
      return false;
    }
    if (!m_topics.isWanted(topic->second)) {
      m_topics.passOver(topic->second);
      return false;
    }
    return m_topics.decode(topic->second, textAt(row, 2), sqlite3_column_int64(row, 1), m_message);
  }

  std::vector<File> m_files;
  DecodedTopics m_topics;
  std::priority_queue<HeadTime, std::vector<HeadTime>, std::greater<>> m_heads;
  std::optional<std::size_t> m_current;
  bool m_began = false;
  std::uint64_t m_read = 0, m_total = 0, m_unknown = 0;
  std::vector<std::string> m_damage;
};

}  // namespace

bool isRosbag2Database(const std::string&, std::string_view beginning) {
  return beginning.starts_with(std::string_view("SQLite format 3\0", 16));
}

OpenedRecording openRosbag2Database(const std::vector<std::string>& files,
                                    const RecordingProgress&) {
  auto recording = std::make_unique<Rosbag2Recording>();
  for (const std::string& file : files) TRY(recording->add(file));
  return recording;
}

}  // namespace pitchboard::telemetry
