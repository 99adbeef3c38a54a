// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/mcap/mcap_chunk.h>

#include <array>

#include "mcap_bytes.h"

namespace pitchboard::telemetry {

void McapChunk::add(const McapSchema& schema) {
  putSchema(m_body, schema);
  m_schemas.push_back(schema);
}

void McapChunk::add(const McapChannel& channel) {
  putChannel(m_body, channel);
  m_channels.push_back(channel);
}

void McapChunk::addHead(const McapMessage& head, std::size_t size) {
  m_index.push_back({head.logTime, m_body.size(), head.channel});
  std::array<char, recordHead + messageHead> bytes{};
  char* at = bytes.data();
  const auto put = [&at](auto value) {
    std::memcpy(at, &value, sizeof value);
    at += sizeof value;
  };
  put(static_cast<std::uint8_t>(McapOp::Message));
  put(static_cast<std::uint64_t>(messageHead + size));
  put(head.channel);
  put(head.sequence);
  put(head.logTime);
  put(head.publishTime);
  m_body.append(bytes.data(), bytes.size());
}

char* McapChunk::addMessage(std::uint16_t channel, std::uint32_t sequence, std::uint64_t logTime,
                            std::uint64_t publishTime, std::size_t size) {
  addHead({channel, sequence, logTime, publishTime, {}}, size);
  m_body.resize(m_body.size() + size);
  return m_body.data() + m_body.size() - size;
}

void McapChunk::add(const McapMessage& message) {
  add(message, {});
}

void McapChunk::add(const McapMessage& message, std::string_view more) {
  addHead(message, message.data.size() + more.size());
  m_body += message.data;
  m_body += more;
}

void McapChunk::clear() {
  m_body.clear();
  m_index.clear();
  m_schemas.clear();
  m_channels.clear();
}

}  // namespace pitchboard::telemetry
