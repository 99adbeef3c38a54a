// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a chunk without the messages that nobody wants, such as images of megabytes: their bytes
// are passed over where the index of messages says where they are and the chunk is not packed.

#include <algorithm>
#include <optional>
#include <vector>

#include "mcap_bytes.h"
#include "mcap_form.h"
#include "mcap_reader_impl.h"

namespace pitchboard::telemetry {
namespace {

/// Passing over less than this costs more than reading it.
constexpr std::uint64_t leastPassedOver = 16U << 10U;
/// Heads of chunks and messages are far apart; reading more around them would be reading images.
constexpr std::size_t headWindow = 512, indexWindow = 16U << 10U;

}  // namespace

/// Where messages begin that may be passed over, in order. Nothing if there is no index.
std::optional<std::vector<std::uint64_t>> McapReader::Impl::unwantedIn(
    const McapChunkInfo& chunk, const std::function<bool(std::uint16_t)>& isWanted) const {
  std::vector<std::uint64_t> unwanted;
  std::uint64_t at = chunk.offset + chunk.length;
  bool isIndexed = false;
  for (;;) {
    const RecordHead head = headIn(source.look(at, recordHead, indexWindow));
    if (!head.whole || head.op != McapOp::MessageIndex || !lengthFits(head.op, head.length) ||
        head.length > chunk.length + maxHeadLength) {
      break;
    }
    const auto length = static_cast<std::size_t>(head.length);
    const std::string_view record = source.look(at + recordHead, length, indexWindow);
    if (record.size() != length) break;
    isIndexed = true;
    RecordReader in(record);
    const auto channel = in.number<std::uint16_t>();
    RecordReader entries(in.text());
    while (!isWanted(channel) && entries.left() >= 16) {
      entries.number<std::uint64_t>();
      unwanted.push_back(entries.number<std::uint64_t>());
    }
    at += recordHead + head.length;
  }
  if (!isIndexed) return {};
  std::ranges::sort(unwanted);
  return unwanted;
}

bool McapReader::Impl::pick(const McapChunkInfo& chunk,
                            const std::function<bool(std::uint16_t)>& isWanted,
                            std::string& body) const {
  if (chunk.loose || !chunk.compression.empty()) return false;
  const std::string_view look =
      source.look(chunk.offset,
                  static_cast<std::size_t>(std::min<std::uint64_t>(256, chunk.length)), headWindow);
  const RecordHead record = headIn(look);
  if (!record.whole || record.op != McapOp::Chunk || record.length != chunk.length - recordHead) {
    return false;
  }
  const auto head = parseChunkHead(look.substr(recordHead), record.length);
  if (!head || !head->info.compression.empty()) return false;
  const std::uint64_t begin = chunk.offset + recordHead + head->recordsAt;
  const std::uint64_t size = head->info.compressedSize;
  const auto unwanted = unwantedIn(chunk, isWanted);
  if (!unwanted || unwanted->empty()) return false;
  std::size_t kept = 0;    // bytes of `body`; what it held before is written over
  std::uint64_t from = 0;  // what is kept since the last message that was passed over
  const auto keepUntil = [&](std::uint64_t until) {
    if (until - from > options.maxChunkBytes - std::min(kept, options.maxChunkBytes)) return false;
    const auto count = static_cast<std::size_t>(until - from);
    if (body.size() < kept + count) body.resize(kept + count);
    kept += count;
    return source.readInto(begin + from, body.data() + kept - count, count);
  };
  for (const std::uint64_t offset : *unwanted) {
    if (offset < from || offset > size) return false;
    const RecordHead message = headIn(source.look(begin + offset, recordHead, headWindow));
    if (!message.whole || message.op != McapOp::Message || message.length > size - offset ||
        size - offset - message.length < recordHead) {
      return false;
    }
    if (message.length < leastPassedOver) continue;
    if (!keepUntil(offset)) return false;
    from = offset + recordHead + message.length;
  }
  if (!keepUntil(size)) return false;
  body.resize(kept);
  return true;
}

Result<void> McapReader::readChunk(const McapChunkInfo& chunk,
                                   const std::function<bool(std::uint16_t)>& isWanted,
                                   std::string& body) const {
  if (m_impl->pick(chunk, isWanted, body)) return {};
  return m_impl->readChunk(chunk, body);
}

}  // namespace pitchboard::telemetry
