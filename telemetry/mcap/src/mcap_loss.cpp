// SPDX-License-Identifier: GPL-3.0-or-later
// What a file still tells of its parts that cannot be read: their times, how many messages.

#include <algorithm>
#include <limits>

#include "mcap_bytes.h"
#include "mcap_form.h"
#include "mcap_reader_impl.h"

namespace pitchboard::telemetry {

std::uint64_t McapReader::Impl::addIndexes(std::uint64_t at, McapLoss& loss) const {
  std::string record;
  for (;;) {
    if (!source.read(at, recordHead, record)) return at;
    const RecordHead head = headIn(record);
    if (head.op != McapOp::MessageIndex || head.length > source.size() - at - recordHead ||
        !lengthFits(head.op, head.length) ||
        !source.read(at + recordHead, static_cast<std::size_t>(head.length), record) ||
        !formFits(head.op, record, head.length)) {
      return at;
    }
    RecordReader in(record);
    in.number<std::uint16_t>();
    in.number<std::uint32_t>();
    for (; in.left() > 0; in.number<std::uint64_t>()) {
      const auto time = in.number<std::uint64_t>();
      const bool first = loss.messages.value_or(0) == 0;
      loss.start = first ? time : std::min(loss.start, time);
      loss.end = first ? time : std::max(loss.end, time);
      loss.messages = loss.messages.value_or(0) + 1;
    }
    at += recordHead + head.length;
  }
}

McapLoss McapReader::Impl::lossOf(const McapChunkInfo& chunk, std::string reason) const {
  McapLoss loss{.offset = chunk.offset, .bytes = chunk.length, .reason = std::move(reason)};
  if (chunk.end == 0) loss.messages = 0;  // definitions only
  if (chunk.start <= chunk.end) {
    loss.start = chunk.start;
    loss.end = chunk.end;
  }
  // Behind a chunk stand the indexes of its messages, outside of its checksum and compression.
  addIndexes(chunk.offset + chunk.length, loss);
  return loss;
}

void McapReader::Impl::lookAtHead(bool found, McapLoss& loss) const {
  const auto head = parseChunkHead(source.look(loss.offset + recordHead, maxHeadLength),
                                   std::numeric_limits<std::uint64_t>::max());
  if (!head || (head->info.compression != "zstd" && head->info.compression != "lz4")) return;
  const std::uint64_t length = recordHead + head->recordsAt + head->info.compressedSize;
  if (length < loss.bytes || (length > loss.bytes && found)) return;
  if (head->info.end == 0) loss.messages = 0;  // definitions only
  if (head->info.start <= head->info.end) {
    loss.start = head->info.start;
    loss.end = head->info.end;
  }
}

void McapReader::Impl::boundLosses() {
  std::size_t next = 0;  // chunks and losses are in the order of the file
  std::uint64_t before = 0;
  for (McapLoss& loss : losses) {
    for (; next < chunks.size() && chunks[next].offset < loss.offset; ++next) {
      if (chunks[next].end != 0) before = chunks[next].end;
    }
    if (loss.messages == 0U || loss.start != 0 || loss.end != 0) continue;
    const auto behind =
        std::find_if(chunks.begin() + static_cast<std::ptrdiff_t>(next), chunks.end(),
                     [](const McapChunkInfo& chunk) { return chunk.end != 0; });
    loss.start = before;
    if (behind == chunks.end()) continue;
    // Chunks may overlap.
    loss.start = std::min(before, behind->start);
    loss.end = std::max(before, behind->start);
  }
}

}  // namespace pitchboard::telemetry
