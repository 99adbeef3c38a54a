// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A chunk of messages for an MCAP file. It is filled by one thread and then handed to a McapWriter,
// which may belong to another thread. Times are ns since 1970.

#include <cstdint>
#include <string>
#include <vector>

#include <telemetry/mcap/mcap_records.h>

namespace pitchboard::telemetry {

/// The uncompressed body of a chunk, with the index of its messages.
class McapChunk {
 public:
  void add(const McapSchema& schema);
  void add(const McapChannel& channel);
  /// Adds a message of `size` bytes and returns where the caller has to write them. The pointer is
  /// valid until the next call.
  char* addMessage(std::uint16_t channel, std::uint32_t sequence, std::uint64_t logTime,
                   std::uint64_t publishTime, std::size_t size);
  void add(const McapMessage& message);
  /// `more` follows the data of the message.
  void add(const McapMessage& message, std::string_view more);
  void clear();  ///< removes everything, but keeps the memory

  bool empty() const { return m_body.empty(); }
  std::size_t bytes() const { return m_body.size(); }
  std::size_t messages() const { return m_index.size(); }

 private:
  friend class McapWriter;
  struct Entry {
    std::uint64_t logTime;
    std::uint64_t offset;
    std::uint16_t channel;
  };
  /// Everything of a message but its data, which have `size` bytes.
  void addHead(const McapMessage& head, std::size_t size);

  std::string m_body;
  std::vector<Entry> m_index;
  std::vector<McapSchema> m_schemas;
  std::vector<McapChannel> m_channels;
};

}  // namespace pitchboard::telemetry
