// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes rows of the messages of topics, recorded or live: a group for each topic, a column for each
// field. Texts that keep changing become log lines. Times are seconds of the source. Not
// thread-safe.

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include <base/log_line.h>
#include <telemetry/recordings/recording.h>
#include <telemetry/series/row_sink.h>

namespace pitchboard::link {

class TopicGroups {
 public:
  /// Different texts of a column; then it is a text that keeps changing.
  static constexpr std::size_t maxLabels = 64;
  static constexpr std::size_t maxColumns = 2000;  ///< of a topic

  using LogTaker = std::function<void(LogLine)>;
  /// `rows` must outlive this.
  TopicGroups(telemetry::RowSink& rows, LogTaker log) : m_rows(rows), m_log(std::move(log)) {}

  /// Adds a row at `time`. `source` is the number of the recording or program with this topic; if
  /// groups of two have one name, `origin` is added to that of the second.
  void take(std::size_t source, const telemetry::RecordedTopic& topic,
            const telemetry::RecordedMessage& message, double time, const std::string& origin = {});
  void addNotes(std::vector<std::string>& notes) const;
  std::uint64_t variables() const;
  std::uint64_t logLines() const { return m_logLines; }
  /// Returns a name that no group has yet.
  std::string freeName(const std::string& name, const std::string& origin = {});

 private:
  /// Where the fields of a shape go.
  struct Layout {
    std::shared_ptr<const telemetry::RecordedShape> shape;
    std::vector<std::uint32_t> columns;  ///< of each field; noColumn: there are too many
    /// Texts: their fields, and their columns if those take texts.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> texts;
    std::uint64_t refused = 0;  ///< values of a message that have no column
    bool isTextOnly = false;    ///< besides a header
    bool isInOrder = false;     ///< the columns are the first ones of the group, as they come
  };
  struct Texts {
    std::map<std::string, int, std::less<>> codes;
    std::string last;   ///< that was logged
    std::string coded;  ///< the last one that has a code, and its code
    double code = -1.0;
    bool keepsChanging = false;
  };
  struct Group {
    telemetry::GroupInfo info;
    telemetry::GroupId id = 0;
    std::unordered_map<std::string, std::uint32_t> columns;
    std::unordered_map<const telemetry::RecordedShape*, Layout> layouts;
    const Layout* layout = nullptr;        ///< of the last message
    std::map<std::uint32_t, Texts> texts;  ///< by column
    std::vector<double> row;
    double lastTime = 0.0;
    bool isKnown = false;  ///< to the sink
    std::uint64_t empty = 0, late = 0, refused = 0;
  };
  static constexpr std::uint32_t noColumn = ~std::uint32_t{0};

  Group& groupOf(std::size_t source, const telemetry::RecordedTopic& topic, std::size_t index,
                 const std::string& origin);
  const Layout& layoutOf(Group& group, const telemetry::RecordedMessage& message);
  static void sortFields(const Group& group, Layout& layout);
  static void fillRow(Group& group, const Layout& layout, const telemetry::RecordedMessage& message,
                      std::size_t columns);
  std::vector<const Group*> allGroups() const;
  double codeOf(Group& group, std::uint32_t column, std::string_view text, double time,
                bool isLogged);
  void logLine(const Group& group, double time, std::string text);
  void logTexts(const Group& group, const telemetry::RecordedMessage& message, double time);

  telemetry::RowSink& m_rows;
  const LogTaker m_log;
  std::vector<std::vector<std::unique_ptr<Group>>> m_groups;  ///< by source and topic
  std::set<std::string> m_names;
  std::uint64_t m_logLines = 0;
};

}  // namespace pitchboard::link
