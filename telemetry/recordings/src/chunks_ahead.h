// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads the chunks of a recording one after the other on a thread of its own, some ahead of who
// takes them, so that unpacking and decoding share two processors. Private to recordings.

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace pitchboard::telemetry {

struct ChunkEntry {
  std::uint64_t logTime;
  std::size_t topic;
  std::string_view data;
};

/// A chunk that was unpacked, with its messages in the order of their log times.
struct OpenChunk {
  std::string body;
  std::vector<ChunkEntry> entries;
  std::size_t at = 0;                           ///< of the next entry
  std::map<std::size_t, std::uint64_t> passed;  ///< messages that nobody wants, by topic
  std::uint64_t unknown = 0;                    ///< messages of channels that are not defined
  std::vector<std::string> damage;
};

class ChunksAhead {
 public:
  /// `read` fills an empty chunk with that of a number below `count`; called on the thread.
  ChunksAhead(std::size_t count, std::function<void(std::size_t, OpenChunk&)> read);
  ~ChunksAhead();

  /// Waits for the next chunk. Must not be called more than `count` times.
  std::unique_ptr<OpenChunk> next();
  /// The memory of a chunk is used again.
  void giveBack(std::unique_ptr<OpenChunk> chunk);

 private:
  void run();

  const std::size_t m_count;
  const std::function<void(std::size_t, OpenChunk&)> m_read;
  std::mutex m_mutex;  ///< of everything below
  std::condition_variable m_changed;
  std::deque<std::unique_ptr<OpenChunk>> m_ready;
  std::vector<std::unique_ptr<OpenChunk>> m_free;
  std::size_t m_bytes = 0;  ///< in `m_ready`
  bool m_stop = false;
  std::thread m_thread;  ///< begins with the first call of next()
};

}  // namespace pitchboard::telemetry
