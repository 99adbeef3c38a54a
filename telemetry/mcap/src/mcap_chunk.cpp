// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/mcap/mcap_chunk.h>

#include <algorithm>

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

char* McapChunk::addMessage(std::uint16_t channel, std::uint32_t sequence, std::uint64_t logTime,
                            std::uint64_t publishTime, std::size_t size) {
  const std::size_t at = m_body.size();
  m_index.push_back({logTime, at, channel});
  m_body += static_cast<char>(McapOp::Message);
  putNumber(m_body, static_cast<std::uint64_t>(messageHead + size));
  putNumber(m_body, channel);
  putNumber(m_body, sequence);
  putNumber(m_body, logTime);
  putNumber(m_body, publishTime);
  m_body.resize(m_body.size() + size);
  return m_body.data() + at + recordHead + messageHead;
}

void McapChunk::add(const McapMessage& message) {
  char* to = addMessage(message.channel, message.sequence, message.logTime, message.publishTime,
                        message.data.size());
  std::copy(message.data.begin(), message.data.end(), to);
}

void McapChunk::clear() {
  m_body.clear();
  m_index.clear();
  m_schemas.clear();
  m_channels.clear();
}

}  // namespace pitchboard::telemetry
