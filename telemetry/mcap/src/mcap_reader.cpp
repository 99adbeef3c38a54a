// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/byte_sizes.h>
#include <telemetry/mcap/mcap_reader.h>

#include <algorithm>

#include <base/try.h>

#include "mcap_bytes.h"
#include "mcap_form.h"
#include "mcap_reader_impl.h"

namespace pitchboard::telemetry {
namespace {

constexpr std::size_t maxProblems = 100;
constexpr std::uint64_t maxSummaryLength = std::uint64_t{512} << 20;
constexpr std::size_t unpackStep = 256 * kibibyte;

std::string atOffset(std::uint64_t offset) {
  return "at byte " + std::to_string(offset);
}

Error damaged(const McapSource& source, std::uint64_t offset, std::string sentence) {
  return {ErrorCode::ParseError, std::move(sentence), source.name() + " " + atOffset(offset)};
}

}  // namespace

McapReader::McapReader(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
McapReader::McapReader(McapReader&&) noexcept = default;
McapReader& McapReader::operator=(McapReader&&) noexcept = default;
McapReader::~McapReader() = default;

const McapContents& McapReader::contents() const {
  return *m_impl;
}

McapLoss McapReader::lossOf(const McapChunkInfo& chunk, std::string reason) const {
  return m_impl->lossOf(chunk, std::move(reason));
}

Result<McapReader> McapReader::open(const std::string& path, const McapReaderOptions& options) {
  return of(TRY(McapSource::file(path)), options);
}

Result<McapReader> McapReader::openBytes(std::string bytes, const McapReaderOptions& options) {
  return of(McapSource::memory(std::move(bytes)), options);
}

Result<McapReader> McapReader::of(McapSource source, const McapReaderOptions& options) {
  auto impl = std::make_unique<Impl>(std::move(source), options);
  TRY(impl->readHeader());
  impl->indexed = !options.ignoreSummary && impl->readSummary();
  impl->growing = !impl->indexed && !footerOf(impl->source) && impl->source.isBeingWritten(true);
  if (!impl->indexed && !impl->scan()) {
    return failure(ErrorCode::Conflict, "Reading was stopped.", impl->name);
  }
  impl->ended = impl->ended || impl->indexed;
  impl->growing = impl->growing && !impl->ended;
  impl->whole = impl->indexed || (impl->ended && footerOf(impl->source) && impl->problems.empty() &&
                                  impl->losses.empty());
  return McapReader(std::move(impl));
}

void McapReader::Impl::problem(std::uint64_t offset, const std::string& sentence) {
  if (problems.size() >= maxProblems) return;
  problems.push_back("At byte " + std::to_string(offset) + ": " + sentence);
}

Result<void> McapReader::Impl::readHeader() {
  const std::string_view magic(mcapMagic.data(), mcapMagic.size());
  const std::string begin(source.look(0, magic.size()));
  if (begin.size() == magic.size() && begin.substr(0, 5) == magic.substr(0, 5) && begin != magic) {
    return tl::unexpected(
        Error{ErrorCode::Unsupported, "This MCAP version is not supported.", source.name()});
  }
  if (begin.empty()) {
    return tl::unexpected(Error{ErrorCode::ParseError, "This file is empty.", source.name()});
  }
  if (begin != magic) {
    return tl::unexpected(
        Error{ErrorCode::ParseError,
              "This is not an MCAP file: it does not begin with the bytes of one.", source.name()});
  }
  dataBegin = magic.size();
  const RecordHead head = headIn(source.look(dataBegin, recordHead));
  const std::string content(source.look(dataBegin + recordHead, maxHeadLength));
  RecordReader in(content);
  profile = in.text();
  library = in.text();
  if (head.op == McapOp::Header && in.ok() && in.offset() == head.length) {
    dataBegin += recordHead + head.length;
    return {};
  }
  // One of opcode, length and content may be damaged; then the others tell where it ends.
  problem(dataBegin, "the header is damaged.");
  for (const std::uint64_t length : {head.length, std::uint64_t{in.offset()}}) {
    if (length > maxHeadLength ||
        !mayEnd(source, dataBegin + recordHead + length, McapOp::Header)) {
      continue;
    }
    dataBegin += recordHead + length;
    break;
  }
  return {};
}

bool McapReader::Impl::readSummary() {
  const auto footer = footerOf(source);
  // Without: a recording that broke off; the walk through the file tells the rest.
  if (!footer || footer->summary == 0) return false;
  const std::uint64_t footerAt = footer->offset, start = footer->summary;
  if (footerAt < dataBegin || start < dataBegin || start > footerAt ||
      footerAt - start > maxSummaryLength) {
    problem(footerAt, "the footer points outside the file; the summary is not used.");
    return false;
  }
  std::string summary;
  const std::size_t covered = static_cast<std::size_t>(footerAt - start) + recordHead + 16;
  if (!source.read(start, covered, summary)) return false;
  if (footer->crc != 0 && extendedCrc(0, summary) != footer->crc) {
    problem(start, "the checksum of the summary is wrong; it is not used.");
    return false;
  }
  summary.resize(static_cast<std::size_t>(footerAt - start));
  const Summary taken = takeSummary(summary);
  if (taken == Summary::Complete) return true;
  if (taken == Summary::Damaged) problem(start, "the summary is damaged; it is not used.");
  schemas.clear();
  channels.clear();
  chunks.clear();
  attachments.clear();
  metadata.clear();
  statistics = {};
  return false;
}

McapReader::Impl::Summary McapReader::Impl::takeSummary(std::string_view summary) {
  const auto inside = [&](std::uint64_t offset, std::uint64_t length) {
    return offset >= mcapMagic.size() && length >= recordHead && offset <= source.size() &&
           length <= source.size() - offset;
  };
  bool counted = false;
  RecordReader in(summary);
  while (in.left() > 0) {
    const auto op = static_cast<McapOp>(in.number<std::uint8_t>());
    const auto content = in.bytes(in.number<std::uint64_t>());
    if (!in.ok()) return Summary::Damaged;
    switch (op) {
      case McapOp::Schema: {
        auto schema = parseSchema(content);
        if (!schema) return Summary::Damaged;
        schemas.insert_or_assign(schema->id, std::move(*schema));
        break;
      }
      case McapOp::Channel: {
        auto channel = parseChannel(content);
        if (!channel) return Summary::Damaged;
        channels.insert_or_assign(channel->id, std::move(*channel));
        break;
      }
      case McapOp::ChunkIndex: {
        auto chunk = parseChunkIndex(content);
        if (!chunk || !inside(chunk->offset, chunk->length)) return Summary::Damaged;
        chunks.push_back(std::move(*chunk));
        break;
      }
      case McapOp::AttachmentIndex: {
        auto info = parseAttachmentIndex(content);
        if (!info || !inside(info->offset, info->length)) return Summary::Damaged;
        attachments.push_back(std::move(*info));
        break;
      }
      case McapOp::MetadataIndex: {
        auto info = parseMetadataIndex(content);
        if (!info || !inside(info->offset, info->length)) return Summary::Damaged;
        metadata.push_back(std::move(*info));
        break;
      }
      case McapOp::Statistics: {
        auto found = parseStatistics(content);
        if (!found) return Summary::Damaged;
        statistics = std::move(*found);
        counted = true;
        break;
      }
      default:
        break;
    }
  }
  std::sort(chunks.begin(), chunks.end(),
            [](const auto& a, const auto& b) { return a.offset < b.offset; });
  // Without chunks the messages, if any, stand loose in the file and only a walk finds them.
  const bool isComplete =
      counted && chunks.size() >= statistics.chunks &&
      attachments.size() >= statistics.attachments && metadata.size() >= statistics.metadata &&
      (!chunks.empty() || statistics.messages == 0) &&
      std::ranges::all_of(statistics.perChannel, [this](const auto& one) {
        const auto channel = channels.find(one.first);
        return channel != channels.end() &&
               (channel->second.schema == 0 || schemas.contains(channel->second.schema));
      });
  return isComplete ? Summary::Complete : Summary::Partial;
}

Result<void> McapReader::Impl::unpack(std::string_view bytes, std::uint64_t size,
                                      std::string& body) const {
  const auto wrong = [](std::string sentence) {
    return failure(ErrorCode::ParseError, std::move(sentence));
  };
  // What a chunk says of its size is believed only as far as its packed bytes make it likely.
  if (size <= believedSize(bytes.size())) {
    body.resize(static_cast<std::size_t>(size));
    const std::size_t got =
        ZSTD_decompressDCtx(unpacker, body.data(), body.size(), bytes.data(), bytes.size());
    if (ZSTD_isError(got)) {
      return wrong(std::string("it cannot be decompressed (") + ZSTD_getErrorName(got) + ")");
    }
    if (got != size) return wrong("its size differs from its header");
    return {};
  }
  ZSTD_DCtx_reset(unpacker, ZSTD_reset_session_only);
  body.clear();
  ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
  for (;;) {
    const std::size_t at = body.size();
    body.resize(at + unpackStep);
    ZSTD_outBuffer out{body.data() + at, unpackStep, 0};
    const std::size_t left = ZSTD_decompressStream(unpacker, &out, &in);
    body.resize(at + out.pos);
    if (ZSTD_isError(left)) {
      return wrong(std::string("it cannot be decompressed (") + ZSTD_getErrorName(left) + ")");
    }
    if (body.size() > size) return wrong("its size differs from its header");
    if ((left == 0 || out.pos == 0) && in.pos == in.size) break;
  }
  if (body.size() != size) return wrong("its size differs from its header");
  return {};
}

Result<void> McapReader::Impl::unpackLz4(std::string_view bytes, std::uint64_t size,
                                         std::string& body) const {
  const auto wrong = [](std::string sentence) {
    return failure(ErrorCode::ParseError, std::move(sentence));
  };
  if (lz4Unpacker == nullptr &&
      LZ4F_isError(LZ4F_createDecompressionContext(&lz4Unpacker, LZ4F_VERSION))) {
    return wrong("there is not enough memory for decompressing it");
  }
  LZ4F_resetDecompressionContext(lz4Unpacker);
  body.clear();
  std::size_t at = 0;
  for (std::size_t hint = 1; hint != 0;) {
    // What a chunk says of its size is believed only as far as its packed bytes make it likely.
    const std::uint64_t room = std::min<std::uint64_t>(
        size - body.size(), body.empty() ? believedSize(bytes.size()) : unpackStep);
    const std::size_t begin = body.size();
    body.resize(begin + static_cast<std::size_t>(room) + 1);  // one more shows what is too long
    std::size_t got = body.size() - begin, taken = bytes.size() - at;
    hint =
        LZ4F_decompress(lz4Unpacker, body.data() + begin, &got, bytes.data() + at, &taken, nullptr);
    body.resize(begin + got);
    at += taken;
    if (LZ4F_isError(hint)) {
      return wrong(std::string("it cannot be decompressed (") + LZ4F_getErrorName(hint) + ")");
    }
    if (body.size() > size || (got == 0 && taken == 0)) break;
  }
  if (body.size() != size || at != bytes.size()) return wrong("its size differs from its header");
  return {};
}

Result<void> McapReader::Impl::readChunk(const McapChunkInfo& chunk, std::string& body) const {
  const auto wrong = [&](const std::string& why) {
    return tl::unexpected(damaged(source, chunk.offset, "This part is damaged: " + why + "."));
  };
  if (chunk.loose) {
    if (!source.read(chunk.offset, static_cast<std::size_t>(chunk.length), body)) {
      return wrong("it cannot be read");
    }
    return {};
  }
  const std::string_view look = source.look(
      chunk.offset, static_cast<std::size_t>(std::min<std::uint64_t>(256, chunk.length)));
  RecordReader in(look);
  const auto op = in.number<std::uint8_t>();
  const auto length = in.number<std::uint64_t>();
  if (!in.ok() || op != static_cast<std::uint8_t>(McapOp::Chunk) ||
      length != chunk.length - recordHead) {
    return wrong("there is no chunk at this position");
  }
  const auto head = parseChunkHead(look.substr(recordHead), length);
  if (!head) return wrong("its header is invalid");
  if (head->info.uncompressedSize > options.maxChunkBytes) {
    return wrong("its uncompressed size of " + std::to_string(head->info.uncompressedSize) +
                 " bytes is above the limit");
  }
  const bool plain = head->info.compression.empty();
  const bool isLz4 = head->info.compression == "lz4";
  if (!plain && !isLz4 && head->info.compression != "zstd") {
    return tl::unexpected(Error{ErrorCode::Unsupported,
                                "This part uses the compression \"" +
                                    head->info.compression.substr(0, 20) +
                                    "\", which is not supported.",
                                source.name() + " " + atOffset(chunk.offset)});
  }
  if (!source.read(chunk.offset + recordHead + head->recordsAt,
                   static_cast<std::size_t>(head->info.compressedSize), plain ? body : packed)) {
    return wrong("it cannot be read");
  }
  if (!plain) {
    const std::uint64_t size = head->info.uncompressedSize;
    if (auto done = isLz4 ? unpackLz4(packed, size, body) : unpack(packed, size, body); !done) {
      return wrong(done.error().message);
    }
  }
  if (head->crc != 0 && extendedCrc(0, body) != head->crc) return wrong("its checksum is wrong");
  return {};
}

Result<void> McapReader::readChunk(const McapChunkInfo& chunk, std::string& body) const {
  return m_impl->readChunk(chunk, body);
}

Result<std::string> McapReader::readAttachment(const McapAttachmentInfo& attachment) const {
  const McapSource& source = m_impl->source;
  const auto wrong = [&](const char* why) {
    return tl::unexpected(
        damaged(source, attachment.offset,
                "The attachment \"" + attachment.name + "\" is damaged: " + why + "."));
  };
  if (attachment.length > m_impl->options.maxAttachmentBytes) return wrong("it is too large");
  std::string record;
  if (!source.read(attachment.offset, static_cast<std::size_t>(attachment.length), record)) {
    return wrong("it cannot be read");
  }
  RecordReader in(record);
  if (in.number<std::uint8_t>() != static_cast<std::uint8_t>(McapOp::Attachment) ||
      in.number<std::uint64_t>() != record.size() - recordHead) {
    return wrong("there is none here");
  }
  const std::string_view content = std::string_view(record).substr(recordHead);
  const auto head = parseAttachmentHead(content.substr(0, maxHeadLength), content.size());
  if (!head) return wrong("its header is invalid");
  const std::size_t covered = head->dataAt + static_cast<std::size_t>(head->info.dataSize);
  const auto crc = RecordReader(content.substr(covered)).number<std::uint32_t>();
  if (crc != 0 && crc != extendedCrc(0, content.substr(0, covered)))
    return wrong("its checksum is wrong");
  return std::string(content.substr(head->dataAt, static_cast<std::size_t>(head->info.dataSize)));
}

Result<McapMap> McapReader::readMetadata(const McapMetadataInfo& metadata) const {
  const McapSource& source = m_impl->source;
  std::string record;
  if (metadata.length <= m_impl->options.maxAttachmentBytes &&
      source.read(metadata.offset, static_cast<std::size_t>(metadata.length), record)) {
    RecordReader in(record);
    const auto op = in.number<std::uint8_t>();
    RecordReader content(in.bytes(in.number<std::uint64_t>()));
    content.text();
    McapMap values = content.map();
    if (op == static_cast<std::uint8_t>(McapOp::Metadata) && in.ok() && content.ok()) return values;
  }
  return tl::unexpected(
      damaged(source, metadata.offset, "The metadata \"" + metadata.name + "\" is damaged."));
}

}  // namespace pitchboard::telemetry
