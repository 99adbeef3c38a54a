// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Writes an MCAP file: chunks compressed by zstd with checksums, message indexes, attachments,
// metadata, and at the end the summary that lets readers find everything. After every writeChunk()
// the file holds whole records only, so that what was written before a crash can be read. Schemas
// and channels are repeated in chunks of their own now and then, so that damage of one chunk costs
// that chunk and not the meaning of the others.

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
  int level = 3;     ///< of zstd
  bool sync = true;  ///< the disk is asked to keep every chunk, and finish() waits until it does
};

/// One thread. Every function that writes fails with what the system said; nothing is written after
/// a failure but by finish().
class McapWriter {
 public:
  /// Error Conflict when the file exists (it is left alone), SystemError when it cannot be made.
  static Result<McapWriter> create(const std::string& path, const McapWriterOptions& options = {});
  /// Into a file that was begun already, e.g. by FileTarget.
  static Result<McapWriter> create(NewFile file, const McapWriterOptions& options = {});
  McapWriter(McapWriter&&) noexcept;
  McapWriter& operator=(McapWriter&&) noexcept;
  ~McapWriter();  ///< closes the file as it is

  /// After an error the file ends behind the last whole chunk. Fails also when the file was
  /// removed.
  Result<void> writeChunk(const McapChunk& chunk);
  Result<void> attach(std::uint64_t logTime, std::uint64_t createTime, std::string_view name,
                      std::string_view mediaType, std::string_view data);
  Result<void> metadata(std::string_view name, const McapMap& values);
  /// Asks the disk to keep what was written (with options.sync), and does not wait for it; the
  /// error is that of an earlier time.
  Result<void> sync();
  /// Writes the summary and closes. Possible after an error too: room for it is kept on the disk
  /// where the file system can; without it the file needs repair.
  Result<void> finish();

  std::uint64_t bytes() const;  ///< of the file so far
  /// How long the disk has been owing an answer, s. Any thread, until finish().
  double owedSeconds() const;
  const McapStatistics& statistics() const;

 private:
  struct Impl;
  Result<void> writeOne(const McapChunk& chunk);
  explicit McapWriter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> m_impl;
};

}  // namespace pitchboard::telemetry
