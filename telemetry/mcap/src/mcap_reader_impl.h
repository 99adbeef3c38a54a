// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What McapReader knows of a file, filled by the summary (mcap_reader.cpp) or by walking through
// the file (mcap_scan.cpp, mcap_loss.cpp).

#include <lz4frame.h>
#include <zstd.h>
#include <functional>
#include <optional>
#include <vector>

#include <telemetry/mcap/mcap_reader.h>

#include "mcap_parse.h"
#include "mcap_source.h"

namespace pitchboard::telemetry {

struct McapReader::Impl : McapContents {
  McapSource source;
  McapReaderOptions options;
  ZSTD_DCtx* unpacker = ZSTD_createDCtx();
  mutable LZ4F_dctx* lz4Unpacker = nullptr;  ///< made with the first such chunk
  std::uint64_t dataBegin = 0;               ///< behind the header
  mutable std::string packed;

  Impl(McapSource s, const McapReaderOptions& o) : source(std::move(s)), options(o) {
    name = source.name();
    fileBytes = source.size();
  }
  ~Impl() {
    ZSTD_freeDCtx(unpacker);
    LZ4F_freeDecompressionContext(lz4Unpacker);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void problem(std::uint64_t offset, const std::string& sentence);
  Result<void> readHeader();
  /// False: there is none, it cannot be trusted, or it leaves out what another program did not have
  /// to write. Then nothing was taken from it.
  bool readSummary();
  /// False: options.progress said stop.
  bool scan();
  Result<void> readChunk(const McapChunkInfo& chunk, std::string& body) const;
  /// Reads a chunk without the messages of unwanted channels. False: that is not possible, and
  /// `body` is of no use.
  bool pick(const McapChunkInfo& chunk, const std::function<bool(std::uint16_t)>& isWanted,
            std::string& body) const;
  std::optional<std::vector<std::uint64_t>> unwantedIn(
      const McapChunkInfo& chunk, const std::function<bool(std::uint16_t)>& isWanted) const;
  McapLoss lossOf(const McapChunkInfo& chunk, std::string reason) const;
  /// Adds what the message indexes from `at` on say of a part that is lost; where they end.
  std::uint64_t addIndexes(std::uint64_t at, McapLoss& loss) const;
  /// Takes its times from the head of the chunk that is cut or damaged, where they can be read.
  /// `found`: a record follows behind the loss.
  void lookAtHead(bool found, McapLoss& loss) const;
  /// Losses without times lie between what was found before and behind them.
  void boundLosses();
  /// What unpack() gets ready for at once, whatever the chunk says of its size.
  static std::uint64_t believedSize(std::uint64_t packed) { return packed * 64 + (1U << 20); }
  Result<void> unpack(std::string_view bytes, std::uint64_t size, std::string& body) const;
  /// The same for a frame of LZ4.
  Result<void> unpackLz4(std::string_view bytes, std::uint64_t size, std::string& body) const;

 private:
  enum class Summary : std::uint8_t { Damaged, Partial, Complete };
  Summary takeSummary(std::string_view summary);
};

}  // namespace pitchboard::telemetry
