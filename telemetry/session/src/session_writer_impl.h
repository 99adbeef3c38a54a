// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a SessionWriter has between those who append and its thread, which compresses and writes.
// Private to session_writer.cpp (appending) and session_writer_thread.cpp.

#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include <telemetry/mcap/mcap_writer.h>
#include <telemetry/session/session_writer.h>

#include "session_format.h"
#include "session_summary.h"

namespace pitchboard::telemetry {

struct SessionWriter::Impl {
  using Clock = std::chrono::steady_clock;
  static constexpr std::uint16_t mostChannels = 60'000;
  struct Attachment {
    std::uint64_t time;
    std::string name, mediaType, data;
  };

  std::string path;
  SessionInfo info;
  SessionWriterOptions options;
  std::optional<McapWriter> file;  ///< of the writing thread once it runs
  std::thread thread;

  struct Group {
    GroupInfo info;
    session::RowLayout layout;
    std::string topic;
    std::uint16_t channel = 0;
    std::uint32_t sequence = 0;
    std::uint64_t lastLog = 0;
    SummaryBuilder summary;
    std::uint16_t summaryChannel = 0;  ///< 0: there is no part yet
    std::uint32_t summaries = 0;
  };

  mutable std::mutex mutex;  ///< of everything below
  std::condition_variable wake, room;
  std::deque<McapChunk> full;
  McapChunk current;
  McapChunk sparse;  ///< events and log lines: who lists them need not read the rows
  std::vector<McapChunk> spare;
  std::deque<Attachment> attachments;
  std::size_t waiting = 0;  ///< bytes in `full`, and what the writing thread has in hand
  bool stop = false;
  std::vector<Group> groups;
  static constexpr std::size_t noGroup = static_cast<std::size_t>(-1);
  struct Copied {
    std::size_t group = noGroup;
    bool isSparse = false;
  };
  std::map<std::uint16_t, Copied> copied;  ///< channels of another file
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
  void write(std::deque<McapChunk>& chunks, std::deque<Attachment>& files);
  bool hasRoom(std::unique_lock<std::mutex>& lock, std::size_t bytes);
  void fail(const Error& why);
  void closeCurrent();
  bool isEmpty() const { return current.empty() && sparse.empty(); }
  std::size_t openBytes() const { return current.bytes() + sparse.bytes(); }
  std::uint16_t addSchema(McapChunk& to, McapSchema schema);
  std::uint16_t addChannel(McapChunk& to, McapChannel channel);
  void summarize(Group& group, std::uint64_t log, const RowView& row);
  void keep(Group& group, const SummaryPart& part);
  void note(std::uint64_t log);
};

}  // namespace pitchboard::telemetry
