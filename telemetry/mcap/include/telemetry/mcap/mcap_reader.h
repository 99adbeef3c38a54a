// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads MCAP files, also truncated, damaged or malicious ones. It uses the summary if that is
// intact, and otherwise scans the whole file. Every length is checked against the rest of the file;
// whatever cannot be read is left out and listed with its offset. It needs memory for one chunk and
// the index. One thread at a time.

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <telemetry/mcap/mcap_records.h>

namespace pitchboard::telemetry {

class McapSource;

struct McapReaderOptions {
  std::size_t maxChunkBytes = std::size_t{128} << 20;  ///< uncompressed; larger chunks are left out
  std::size_t maxAttachmentBytes = std::size_t{256} << 20;
  bool ignoreSummary = false;  ///< always scan the file and check every chunk
  /// Called from time to time with the share of the file that was read (0 to 1). Return false to
  /// cancel, which is an error.
  std::function<bool(double)> progress;
};

struct McapContents {
  std::string name;  ///< path of the file
  std::uint64_t fileBytes = 0;
  /// True if the summary was used. False if the file was scanned, because it is truncated or its
  /// summary is damaged; then every listed chunk was unpacked and checked.
  bool indexed = false;
  /// True if the file has the record that ends its data. False: the recording was cut off, or its
  /// end is damaged.
  bool ended = false;
  /// True if the file has the end that the format asks for and nothing in it is damaged, with or
  /// without a summary, which other programs need not write.
  bool whole = false;
  /// True if it has no end yet because a program is still writing it. What was written when it was
  /// opened is shown.
  bool growing = false;
  std::vector<std::string> problems;  ///< sentences: what is wrong and where; at most 100
  /// The parts that were left out by the scan; they are not repeated in `problems`.
  std::vector<McapLoss> losses;
  std::string profile, library;
  std::map<std::uint16_t, McapSchema> schemas;
  std::map<std::uint16_t, McapChannel> channels;
  std::vector<McapChunkInfo> chunks;  ///< in the order of the file
  std::vector<McapAttachmentInfo> attachments;
  std::vector<McapMetadataInfo> metadata;
  McapStatistics statistics;  ///< from the summary, or counted
};

class McapReader {
 public:
  /// Opens a file. Fails with NotFound or SystemError if it cannot be opened, ParseError if it is
  /// no MCAP file, Unsupported if it is of a later version. Damage is no error: see McapContents.
  static Result<McapReader> open(const std::string& path, const McapReaderOptions& options = {});
  static Result<McapReader> openBytes(std::string bytes, const McapReaderOptions& options = {});
  McapReader(McapReader&&) noexcept;
  McapReader& operator=(McapReader&&) noexcept;
  ~McapReader();

  /// Returns the index of the file and its problems; valid as long as the reader.
  const McapContents& contents() const;
  /// Returns what is lost with a chunk that readChunk() could not read; `reason` is its message.
  McapLoss lossOf(const McapChunkInfo& chunk, std::string reason) const;

  /// Unpacks a chunk into `body`, whose memory is reused. Fails with ParseError and the offset if
  /// the chunk is damaged, with Unsupported if its compression is unknown.
  Result<void> readChunk(const McapChunkInfo& chunk, std::string& body) const;
  /// The same, without large messages of channels for which `isWanted` returns false, if the chunk
  /// is not compressed and has an index: their bytes are then not read, and no checksum is checked.
  Result<void> readChunk(const McapChunkInfo& chunk,
                         const std::function<bool(std::uint16_t)>& isWanted,
                         std::string& body) const;
  Result<std::string> readAttachment(const McapAttachmentInfo& attachment) const;
  Result<McapMap> readMetadata(const McapMetadataInfo& metadata) const;

 private:
  friend class McapScan;
  struct Impl;
  static Result<McapReader> of(McapSource source, const McapReaderOptions& options);
  explicit McapReader(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> m_impl;
};

}  // namespace pitchboard::telemetry
