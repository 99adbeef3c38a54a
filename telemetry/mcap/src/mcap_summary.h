// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the end of an MCAP file tells of the whole: collected by the McapWriter, which owns it,
// while it writes. One thread at a time.

#include <cstdint>
#include <string>
#include <vector>

#include <telemetry/mcap/mcap_chunk.h>

namespace pitchboard::telemetry {

struct McapSummary {
  std::vector<McapSchema> schemas;
  std::vector<McapChannel> channels;
  std::string chunkIndexes, attachmentIndexes, metadataIndexes;  ///< records, ready
  std::uint32_t chunks = 0, attachments = 0, metadatas = 0;
  McapStatistics statistics;

  /// Bytes that it will take, about.
  std::uint64_t size() const;
  /// All schemas and channels once more.
  McapChunk definitions() const;
  /// Summary, summary offsets and footer, from file offset `begin` on.
  std::string records(std::uint64_t begin) const;
};

}  // namespace pitchboard::telemetry
