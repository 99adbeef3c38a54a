// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a SessionWriter has in hand. Private to session_writer.cpp (chunks, the writing thread) and
// session_writer_rows.cpp (channels of rows and their summaries).

#include <array>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include <telemetry/mcap/mcap_writer.h>
#include <telemetry/session/session_writer.h>

#include "session_format.h"
#include "session_summary.h"
#include "write_rate.h"

namespace pitchboard::telemetry {

struct SessionWriter::Impl {
  using Clock = std::chrono::steady_clock;
  static constexpr std::uint16_t maxChannels = 60'000;
  using GroupFacts = session::GroupFacts;
  struct Attachment {
    std::uint64_t time;
    std::string name, mediaType, data;
  };

  std::string path;
  SessionInfo info;
  SessionWriterOptions options;
  std::optional<McapWriter> file;  ///< of the writing thread once it runs
  std::thread thread;

  /// A channel with rows.
  struct RowChannel {
    std::vector<ColumnInfo> columns;
    session::RowLayout layout;
    std::string topic;
    std::uint16_t channel = 0;  ///< 0: there are too many, and its rows are dropped
    std::uint32_t sequence = 0;
    std::uint64_t lastLog = 0;
    SummaryBuilder summary;
    std::uint16_t summaryChannel = 0;  ///< 0: there is no part yet
    std::uint32_t summaries = 0;
  };
  struct HeldRow {
    double time;
    std::uint64_t log, publish;
    std::vector<std::uint32_t> words;
    std::vector<double> values;
  };
  /// A group writes each of its rows into one of its channels. A channel that describes many
  /// columns is as large as thousands of rows; one for each new column or text would be most of the
  /// file. Rows with new columns therefore wait until a channel for all of them is due, and new
  /// texts are described from time to time.
  struct Group {
    GroupInfo info;                      ///< as its rows come now
    std::vector<std::size_t> channels;   ///< of `rowChannels`
    std::optional<std::size_t> takes{};  ///< the channel with the columns of `info`
    bool isDescribed = false;            ///< that channel also has the labels of `info`
    std::optional<std::size_t> last{};   ///< the channel of the last row
    std::uint64_t lastLog = 0;
    double openedAt = -std::numeric_limits<double>::infinity();  ///< s; its newest channel
    double wait = 0.0;                                           ///< s; until the next channel
    std::vector<HeldRow> held{};  ///< their columns are those of `info`, or its first ones
    Clock::time_point heldAt{};
  };
  static std::size_t bytesOf(const HeldRow& row) {
    return sizeof row + 4 * row.words.size() + 8 * row.values.size();
  }
  static constexpr double minWait = 1.0, maxHold = 8.0, maxWait = 64.0;  // s

  mutable std::mutex mutex;  ///< of everything below
  std::condition_variable wake, room;
  std::deque<McapChunk> full;
  McapChunk current;
  McapChunk sparse;  ///< events and log lines: who lists them need not read the rows
  std::vector<McapChunk> spare;
  std::deque<Attachment> attachments;
  std::size_t waiting = 0;  ///< bytes in `full`, and what the writing thread has in hand
  bool stop = false;
  std::vector<RowChannel> rowChannels;
  std::vector<Group> groups;
  std::map<std::string, std::size_t> groupsByKey;
  std::size_t heldBytes = 0;
  std::map<std::string, GroupFacts> facts;     ///< of groups by their ids, as they are known now
  std::map<std::string, GroupFacts> newFacts;  ///< those of them that are not in the file yet
  struct Copied {
    std::optional<std::size_t> rows{};  ///< of `rowChannels`
    std::size_t group = 0;              ///< with rows
    bool isSparse = false;
  };
  std::vector<Copied> copied;  ///< channels of another file, by their number in this one
  struct Stream {
    std::uint16_t channel = 0;
    std::uint32_t sequence = 0;
  };
  std::array<Stream, sessionStreamCount> streams{};
  std::uint16_t channels = 0, schemas = 0;
  std::uint64_t shift = 0;  ///< ns; how far the file's times are ahead of the source's
  std::optional<std::uint64_t> firstLog;
  std::uint64_t lastLog = 0;
  SessionStatus state;
  std::optional<Clock::time_point> writingSince;  ///< the writing thread has not come back since
  bool ended = false;                             ///< `file` is not to be asked any more
  std::optional<Error> error;

  void run();
  void write(std::deque<McapChunk>& chunks, std::deque<Attachment>& files,
             const std::map<std::string, GroupFacts>& described);
  void noteFacts(const GroupInfo& info);
  bool hasSpace(std::unique_lock<std::mutex>& lock, std::size_t bytes);
  void fail(const Error& why);
  void closeCurrent();
  bool isEmpty() const { return current.empty() && sparse.empty(); }
  std::size_t openBytes() const { return current.bytes() + sparse.bytes(); }
  // Rows (session_writer_rows.cpp); these need the lock.
  std::size_t indexOf(const GroupInfo& of);
  void openChannel(Group& group, double time);
  void openWhere(const std::function<bool(const Group&)>& wanted);
  bool isDue(const Group& group, double time) const;
  void hold(Group& group, std::uint64_t log, std::uint64_t publish, const RowView& row);
  void write(Group& group, std::uint64_t log, std::uint64_t publish, const RowView& row);
  std::uint16_t addSchema(McapChunk& to, McapSchema schema);
  std::uint16_t addChannel(McapChunk& to, McapChannel channel);
  void summarize(Group& group, std::size_t channel, std::uint64_t log, const RowView& row);
  void keep(RowChannel& channel, const SummaryPart& part);
  void note(std::uint64_t log);
};

}  // namespace pitchboard::telemetry
