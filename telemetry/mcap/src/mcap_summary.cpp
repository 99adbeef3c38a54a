// SPDX-License-Identifier: GPL-3.0-or-later
#include "mcap_summary.h"

#include "mcap_bytes.h"

namespace pitchboard::telemetry {

std::uint64_t McapSummary::size() const {
  std::uint64_t size = chunkIndexes.size() + attachmentIndexes.size() + metadataIndexes.size();
  for (const McapSchema& schema : schemas) size += schema.data.size() + schema.name.size() + 64;
  for (const McapChannel& channel : channels) {
    size += channel.topic.size() + 64;
    for (const auto& [key, value] : channel.metadata) size += key.size() + value.size() + 8;
  }
  return size;
}

McapChunk McapSummary::definitions() const {
  McapChunk chunk;
  for (const McapSchema& schema : schemas) chunk.add(schema);
  for (const McapChannel& channel : channels) chunk.add(channel);
  return chunk;
}

std::string McapSummary::records(std::uint64_t begin) const {
  struct Group {
    McapOp op;
    std::size_t start, length;
  };
  std::string text;
  std::vector<Group> groups;
  const auto group = [&](McapOp op, auto&& fill) {
    const std::size_t start = text.size();
    fill();
    if (text.size() > start) groups.push_back({op, start, text.size() - start});
  };
  group(McapOp::Schema, [&] {
    for (const auto& schema : schemas) putSchema(text, schema);
  });
  group(McapOp::Channel, [&] {
    for (const auto& channel : channels) putChannel(text, channel);
  });
  group(McapOp::ChunkIndex, [&] { text += chunkIndexes; });
  group(McapOp::AttachmentIndex, [&] { text += attachmentIndexes; });
  group(McapOp::MetadataIndex, [&] { text += metadataIndexes; });
  group(McapOp::Statistics, [&] {
    const auto record = beginRecord(text, McapOp::Statistics);
    putNumber(text, statistics.messages);
    putNumber(text, static_cast<std::uint16_t>(schemas.size()));
    putNumber(text, static_cast<std::uint32_t>(channels.size()));
    putNumber(text, attachments);
    putNumber(text, metadatas);
    putNumber(text, chunks);
    putNumber(text, statistics.start);
    putNumber(text, statistics.end);
    putNumber(text, static_cast<std::uint32_t>(statistics.perChannel.size() * 10));
    for (const auto& [channel, count] : statistics.perChannel) {
      putNumber(text, channel);
      putNumber(text, count);
    }
    endRecord(text, record);
  });
  const std::size_t offsets = text.size();
  for (const Group& g : groups) {
    const auto record = beginRecord(text, McapOp::SummaryOffset);
    text += static_cast<char>(g.op);
    putNumber(text, begin + g.start);
    putNumber(text, static_cast<std::uint64_t>(g.length));
    endRecord(text, record);
  }
  const auto footer = beginRecord(text, McapOp::Footer);
  putNumber(text, begin);
  putNumber(text, begin + offsets);
  // The checksum covers the footer's head, whose length is therefore written first.
  setNumber(text, footer - 8, static_cast<std::uint64_t>(footerLength));
  putNumber(text, extendedCrc(0, text));
  text.append(mcapMagic.data(), mcapMagic.size());
  return text;
}

}  // namespace pitchboard::telemetry
