// SPDX-License-Identifier: GPL-3.0-or-later
#include "mcap_parse.h"

#include <algorithm>

#include "mcap_bytes.h"

namespace pitchboard::telemetry {

std::optional<McapSchema> parseSchema(std::string_view content) {
  RecordReader in(content);
  McapSchema schema;
  schema.id = in.number<std::uint16_t>();
  schema.name = in.text();
  schema.encoding = in.text();
  schema.data = in.text();
  if (!in.ok() || schema.id == 0) return std::nullopt;
  return schema;
}

std::optional<McapChannel> parseChannel(std::string_view content) {
  RecordReader in(content);
  McapChannel channel;
  channel.id = in.number<std::uint16_t>();
  channel.schema = in.number<std::uint16_t>();
  channel.topic = in.text();
  channel.messageEncoding = in.text();
  channel.metadata = in.map();
  if (!in.ok()) return std::nullopt;
  return channel;
}

std::optional<McapMessage> parseMessage(std::string_view content) {
  RecordReader in(content);
  McapMessage message;
  message.channel = in.number<std::uint16_t>();
  message.sequence = in.number<std::uint32_t>();
  message.logTime = in.number<std::uint64_t>();
  message.publishTime = in.number<std::uint64_t>();
  if (!in.ok()) return std::nullopt;
  message.data = in.bytes(in.left());
  return message;
}

std::optional<McapChunkInfo> parseChunkIndex(std::string_view content) {
  RecordReader in(content);
  McapChunkInfo chunk;
  chunk.start = in.number<std::uint64_t>();
  chunk.end = in.number<std::uint64_t>();
  chunk.offset = in.number<std::uint64_t>();
  chunk.length = in.number<std::uint64_t>();
  RecordReader places(in.text());
  while (places.left() > 0) {
    chunk.channels.push_back(places.number<std::uint16_t>());
    places.number<std::uint64_t>();
  }
  in.number<std::uint64_t>();
  chunk.compression = in.text();
  chunk.compressedSize = in.number<std::uint64_t>();
  chunk.uncompressedSize = in.number<std::uint64_t>();
  if (!in.ok() || !places.ok()) return std::nullopt;
  std::sort(chunk.channels.begin(), chunk.channels.end());
  return chunk;
}

std::optional<McapAttachmentInfo> parseAttachmentIndex(std::string_view content) {
  RecordReader in(content);
  McapAttachmentInfo info;
  info.offset = in.number<std::uint64_t>();
  info.length = in.number<std::uint64_t>();
  info.logTime = in.number<std::uint64_t>();
  info.createTime = in.number<std::uint64_t>();
  info.dataSize = in.number<std::uint64_t>();
  info.name = in.text();
  info.mediaType = in.text();
  if (!in.ok()) return std::nullopt;
  return info;
}

std::optional<McapMetadataInfo> parseMetadataIndex(std::string_view content) {
  RecordReader in(content);
  McapMetadataInfo info;
  info.offset = in.number<std::uint64_t>();
  info.length = in.number<std::uint64_t>();
  info.name = in.text();
  if (!in.ok()) return std::nullopt;
  return info;
}

std::optional<McapStatistics> parseStatistics(std::string_view content) {
  RecordReader in(content);
  McapStatistics statistics;
  statistics.messages = in.number<std::uint64_t>();
  in.number<std::uint16_t>();
  in.number<std::uint32_t>();
  statistics.attachments = in.number<std::uint32_t>();
  statistics.metadata = in.number<std::uint32_t>();
  statistics.chunks = in.number<std::uint32_t>();
  statistics.start = in.number<std::uint64_t>();
  statistics.end = in.number<std::uint64_t>();
  RecordReader counts(in.text());
  while (counts.left() > 0) {
    const auto channel = counts.number<std::uint16_t>();
    statistics.perChannel[channel] = counts.number<std::uint64_t>();
  }
  if (!in.ok() || !counts.ok()) return std::nullopt;
  return statistics;
}

std::optional<ChunkHead> parseChunkHead(std::string_view beginning, std::uint64_t contentLength) {
  RecordReader in(beginning);
  ChunkHead head;
  head.info.start = in.number<std::uint64_t>();
  head.info.end = in.number<std::uint64_t>();
  head.info.uncompressedSize = in.number<std::uint64_t>();
  head.crc = in.number<std::uint32_t>();
  head.info.compression = in.text();
  head.info.compressedSize = in.number<std::uint64_t>();
  head.recordsAt = in.offset();
  if (!in.ok() || head.recordsAt > contentLength ||
      head.info.compressedSize > contentLength - head.recordsAt) {
    return std::nullopt;
  }
  return head;
}

std::optional<AttachmentHead> parseAttachmentHead(std::string_view beginning,
                                                  std::uint64_t contentLength) {
  RecordReader in(beginning);
  AttachmentHead head;
  head.info.logTime = in.number<std::uint64_t>();
  head.info.createTime = in.number<std::uint64_t>();
  head.info.name = in.text();
  head.info.mediaType = in.text();
  head.info.dataSize = in.number<std::uint64_t>();
  head.dataAt = in.offset();
  if (!in.ok() || head.dataAt > contentLength || contentLength - head.dataAt < 4 ||
      head.info.dataSize > contentLength - head.dataAt - 4) {
    return std::nullopt;
  }
  return head;
}

}  // namespace pitchboard::telemetry
