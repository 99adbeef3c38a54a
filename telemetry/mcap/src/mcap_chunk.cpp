// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/mcap/mcap_chunk.h>

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
  m_body += static_cast<char>(McapOp::Message);
  putNumber(m_body, static_cast<std::uint64_t>(messageHead + size));
  putNumber(m_body, head.channel);
  putNumber(m_body, head.sequence);
  putNumber(m_body, head.logTime);
  putNumber(m_body, head.publishTime);
}

char* McapChunk::addMessage(std::uint16_t channel, std::uint32_t sequence, std::uint64_t logTime,
                            std::uint64_t publishTime, std::size_t size) {
  addHead({channel, sequence, logTime, publishTime, {}}, size);
  m_body.resize(m_body.size() + size);
  return m_body.data() + m_body.size() - size;
}

void McapChunk::add(const McapMessage& message) {
  addHead(message, message.data.size());
  m_body += message.data;
}

void McapChunk::clear() {
  m_body.clear();
  m_index.clear();
  m_schemas.clear();
  m_channels.clear();
}

}  // namespace pitchboard::telemetry
