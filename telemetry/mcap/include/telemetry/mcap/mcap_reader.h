// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads MCAP files, also hostile, cut or damaged ones: by their summary where it is whole, else by
// walking through the file. Every length is checked against what is left; what cannot be read is
// left out and named with its offset. Memory: one chunk and the index. One thread.

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
  std::size_t maxChunkBytes = std::size_t{128} << 20;  ///< unpacked; larger chunks are left out
  std::size_t maxAttachmentBytes = std::size_t{256} << 20;
  bool ignoreSummary = false;  ///< walk through the file in any case, checking every chunk
  /// Called now and then with the part of the file seen (0 to 1); false ends with an error.
  std::function<bool(double)> progress;
};

struct McapContents {
  std::string name;  ///< path of the file
  std::uint64_t fileBytes = 0;
  /// The file has an end and its summary was used. False: it was walked through (a recording that
  /// broke off, or a damaged summary); every chunk that is listed was then unpacked and checked.
  bool indexed = false;
  /// The file holds the end of its data. False: the recording broke off, or the end is damaged.
  bool ended = false;
  std::vector<std::string> problems;  ///< what is wrong and where, in sentences; at most 100
  /// The parts that were left out when the file was walked through; not among the problems.
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
  /// Error NotFound or SystemError (cannot be opened), ParseError (not an MCAP file), Unsupported
  /// (a later version of MCAP). Damage behind the first bytes is no error: see McapContents.
  static Result<McapReader> open(const std::string& path, const McapReaderOptions& options = {});
  static Result<McapReader> openBytes(std::string bytes, const McapReaderOptions& options = {});
  McapReader(McapReader&&) noexcept;
  McapReader& operator=(McapReader&&) noexcept;
  ~McapReader();

  /// What is known of the file, and what is wrong with it.
  const McapContents& contents() const;
  /// What is lost with one of the chunks that readChunk() finds damaged; `reason`: what that said.
  McapLoss lossOf(const McapChunkInfo& chunk, std::string reason) const;

  /// Unpacks the body of one of the chunks into `body` (its memory is used again). Error ParseError
  /// with the offset when it is damaged, Unsupported when the compression is unknown.
  Result<void> readChunk(const McapChunkInfo& chunk, std::string& body) const;
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
