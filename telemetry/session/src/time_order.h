// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Visits the messages of an MCAP file in the order of their log times, whatever order they have in
// the file: recorders interleave groups, and other programs write topic by topic or backwards. Only
// chunks that overlap in time are in memory together. Where that would be more than `memory`, the
// latest messages are dropped and the chunks that hold them are read again later. Times are ns
// since 1970. Private to the library; one thread.

#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <telemetry/mcap/mcap_records.h>

namespace pitchboard::telemetry {

class TimeOrder {
 public:
  static constexpr std::size_t defaultMemory = std::size_t{256} << 20;  ///< bytes

  struct Wanted {
    std::uint64_t begin = 0, end = 0;  ///< both included
    std::function<bool(const McapChunkInfo&)> chunk;
    std::function<bool(std::uint16_t)> channel;
  };
  /// The bytes of a chunk; null if it cannot be read.
  using Body = std::function<std::shared_ptr<const std::string>(std::size_t chunk)>;

  /// The list of chunks must outlive it.
  TimeOrder(const std::vector<McapChunkInfo>& chunks, Body body, std::size_t memory = defaultMemory)
      : m_chunks(chunks), m_body(std::move(body)), m_memory(memory) {}

  /// Messages of equal times come in the order of the file, those of one channel by their sequence.
  /// Returns false if `visit` or `progress` did, which stops. A message is valid during the call.
  bool walk(const Wanted& wanted, const std::function<bool(const McapMessage&)>& visit,
            const std::function<bool(double)>& progress);

 private:
  /// Where a message belongs; the chunk's number and the offset in it decide at equal times.
  struct Key {
    std::uint64_t time = 0;
    std::size_t chunk = 0;
    std::size_t offset = 0;
    auto operator<=>(const Key&) const = default;
  };
  struct Entry {
    Key key;
    std::size_t at = 0;  ///< in the bytes that are held of its chunk
    std::uint32_t sequence = 0;
    std::uint16_t channel = 0;
  };
  struct Held {
    std::shared_ptr<const std::string> bytes;
    std::size_t entries = 0;  ///< that are still needed
  };

  void load(std::size_t chunk, const Wanted& wanted);
  void dropLatest();
  void bySequence(std::size_t begin, std::size_t end);
  bool visitUntil(const Key& limit, const std::function<bool(const McapMessage&)>& visit);
  std::size_t bytesOf(const Entry& entry) const;

  const std::vector<McapChunkInfo>& m_chunks;
  Body m_body;
  std::size_t m_memory;
  std::vector<Entry> m_waiting;  // in order
  std::size_t m_next = 0;        // of them; those before are done
  std::map<std::size_t, Held> m_held;
  std::size_t m_heldBytes = 0;
  Key m_from{};            // of this pass: what is before was visited
  Key m_dropped{};         // from here on, messages were dropped
  bool m_isMixed = false;  // a chunk was not in order
};

}  // namespace pitchboard::telemetry
