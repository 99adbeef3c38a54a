// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Writes an MCAP file: chunks compressed with zstd, or as they are, and protected by checksums,
// message indexes, attachments, metadata, and at the end a summary. After every writeChunk() the
// file holds complete records only, so everything written before a crash can be read. Schemas and
// channels are repeated from time to time, so that a damaged chunk does not make the others
// unreadable.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include <base/new_file.h>
#include <base/result.h>
#include <telemetry/mcap/mcap_chunk.h>
#include <telemetry/mcap/mcap_records.h>

namespace pitchboard::telemetry {

struct McapWriterOptions {
  std::string profile;
  std::string library = "pitchboard";
  /// Compression level of zstd. plainChunks: chunks are written as they are, which is several times
  /// as fast, for files about twice as large.
  int level = 3;
  static constexpr int plainChunks = 0;
  bool sync = true;  ///< flush every chunk to the disk; finish() waits for it
};

/// Used by one thread. A write fails with the system's reason; after a failure only finish() still
/// writes.
class McapWriter {
 public:
  /// Creates a file. Fails with Conflict if it exists (it is not touched), with SystemError if it
  /// cannot be created.
  static Result<McapWriter> create(const std::string& path, const McapWriterOptions& options = {});
  /// Writes into a file that is already open, for example by FileTarget.
  static Result<McapWriter> create(NewFile file, const McapWriterOptions& options = {});
  McapWriter(McapWriter&&) noexcept;
  McapWriter& operator=(McapWriter&&) noexcept;
  ~McapWriter();  ///< closes the file as it is

  /// Appends a chunk. After an error the file ends behind the last complete chunk. Fails also if
  /// somebody removed the file.
  Result<void> writeChunk(const McapChunk& chunk);
  Result<void> attach(std::uint64_t logTime, std::uint64_t createTime, std::string_view name,
                      std::string_view mediaType, std::string_view data);
  Result<void> metadata(std::string_view name, const McapMap& values);
  /// Starts flushing to the disk (with options.sync) and does not wait; a returned error belongs to
  /// an earlier flush.
  Result<void> sync();
  /// Writes the summary and closes the file. Also works after an error: space for it is reserved
  /// if the file system can do that; otherwise the file needs repair.
  Result<void> finish();

  std::uint64_t bytes() const;  ///< size of the file so far
  /// Returns for how long the running flush has taken, in s. Any thread, until finish().
  double syncLatency() const;
  const McapStatistics& statistics() const;

 private:
  struct Impl;
  Result<void> writeOne(const McapChunk& chunk);
  explicit McapWriter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> m_impl;
};

}  // namespace pitchboard::telemetry
