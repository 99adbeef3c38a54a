// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The content of each kind of record. Nothing when it is not of its form; fields that a later
// version added behind the known ones are passed over, as the specification asks.

#include <optional>
#include <string_view>

#include <base/byte_sizes.h>
#include <telemetry/mcap/mcap_records.h>

namespace pitchboard::telemetry {

std::optional<McapSchema> parseSchema(std::string_view content);
std::optional<McapChannel> parseChannel(std::string_view content);
std::optional<McapMessage> parseMessage(std::string_view content);
std::optional<McapChunkInfo> parseChunkIndex(std::string_view content);
std::optional<McapAttachmentInfo> parseAttachmentIndex(std::string_view content);
std::optional<McapMetadataInfo> parseMetadataIndex(std::string_view content);
std::optional<McapStatistics> parseStatistics(std::string_view content);

struct ChunkHead {
  McapChunkInfo info;         ///< offset and length are left for the caller
  std::uint32_t crc = 0;      ///< 0: none
  std::size_t recordsAt = 0;  ///< where the records begin in the content
};
/// Needs only the beginning of the content; `contentLength` is that of the whole record.
std::optional<ChunkHead> parseChunkHead(std::string_view beginning, std::uint64_t contentLength);

struct AttachmentHead {
  McapAttachmentInfo info;
  std::size_t dataAt = 0;
};
std::optional<AttachmentHead> parseAttachmentHead(std::string_view beginning,
                                                  std::uint64_t contentLength);

/// Longest beginning that the two functions above need.
inline constexpr std::size_t maxHeadLength = 64 * kibibyte;

}  // namespace pitchboard::telemetry
