// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The records of MCAP, the open container of robotics logs, version "0". Source: the MCAP file
// format specification (mcap.dev/spec). Little-endian; times are nanoseconds (uint64). Plain
// values; mcap_writer.h writes them, mcap_reader.h reads them.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pitchboard::telemetry {

inline constexpr std::array<char, 8> mcapMagic{'\x89', 'M', 'C', 'A', 'P', '0', '\r', '\n'};

enum class McapOp : std::uint8_t {
  Header = 0x01,
  Footer = 0x02,
  Schema = 0x03,
  Channel = 0x04,
  Message = 0x05,
  Chunk = 0x06,
  MessageIndex = 0x07,
  ChunkIndex = 0x08,
  Attachment = 0x09,
  AttachmentIndex = 0x0a,
  Statistics = 0x0b,
  Metadata = 0x0c,
  MetadataIndex = 0x0d,
  SummaryOffset = 0x0e,
  DataEnd = 0x0f
};

using McapMap = std::map<std::string, std::string, std::less<>>;

struct McapSchema {
  std::uint16_t id = 0;  ///< not 0
  std::string name;
  std::string encoding;  ///< "ros2msg", "jsonschema", ...
  std::string data;
  bool operator==(const McapSchema&) const = default;
};

struct McapChannel {
  std::uint16_t id = 0;
  std::uint16_t schema = 0;  ///< 0: none
  std::string topic;
  std::string messageEncoding;  ///< "cdr", "json", ...
  McapMap metadata;
  bool operator==(const McapChannel&) const = default;
};

struct McapMessage {
  std::uint16_t channel = 0;
  std::uint32_t sequence = 0;
  std::uint64_t logTime = 0;
  std::uint64_t publishTime = 0;
  std::string_view data;
};

/// Position and content of a chunk.
struct McapChunkInfo {
  std::uint64_t offset = 0;          ///< position of the record in the file
  std::uint64_t length = 0;          ///< length of the record, including its header of 9 bytes
  std::uint64_t start = 0, end = 0;  ///< first and last log time; both 0 without messages
  std::string compression;  ///< "zstd", "lz4", "" (none), or one that this program cannot read
  std::uint64_t compressedSize = 0, uncompressedSize = 0;
  std::vector<std::uint16_t> channels;  ///< channels that have messages here; empty if unknown
  /// True for messages that stand in the file outside of chunks, without a checksum.
  bool loose = false;
};

/// A part of a file that cannot be read.
struct McapLoss {
  std::uint64_t offset = 0, bytes = 0;
  /// Log times between which the part lies, start <= end; 0 means from the beginning, to the end.
  std::uint64_t start = 0, end = 0;
  std::optional<std::uint64_t> messages{};  ///< lost messages, if the file says so elsewhere
  bool atLeast = false;                     ///< there may be more than `messages`
  std::string reason{};                     ///< a sentence
};

struct McapAttachmentInfo {
  std::uint64_t offset = 0, length = 0;
  std::uint64_t logTime = 0, createTime = 0;
  std::uint64_t dataSize = 0;
  std::string name, mediaType;
};

struct McapMetadataInfo {
  std::uint64_t offset = 0, length = 0;
  std::string name;
};

struct McapStatistics {
  std::uint64_t messages = 0;
  std::uint64_t start = 0, end = 0;  ///< log times; 0 without messages
  std::map<std::uint16_t, std::uint64_t> perChannel;
  std::uint32_t attachments = 0, metadata = 0, chunks = 0;  ///< as the summary says; else 0
};

}  // namespace pitchboard::telemetry
