// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/byte_sizes.h>
#include <telemetry/mcap/mcap_writer.h>

#include <zstd.h>
#include <algorithm>
#include <bit>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include <base/new_file.h>
#include <base/try.h>
#include <telemetry/mcap/mcap_chunk.h>

#include "disk_sync.h"
#include "mcap_bytes.h"

namespace pitchboard::telemetry {

/// What the end of an MCAP file tells of the whole: collected by the McapWriter, which owns it,
/// while it writes. One thread at a time.
struct McapSummary {
  std::vector<McapSchema> schemas;
  std::vector<McapChannel> channels;
  std::string chunkIndexes, attachmentIndexes, metadataIndexes;  ///< records, ready
  std::uint32_t chunks = 0, attachments = 0, metadatas = 0;
  McapStatistics statistics;

  /// Bytes that it will take, about.
  std::uint64_t size() const;
  /// All schemas and channels once more.
  McapChunk definitions() const;
  /// Summary, summary offsets and footer, from file offset `begin` on.
  std::string records(std::uint64_t begin) const;
};

std::uint64_t McapSummary::size() const {
  std::uint64_t size = chunkIndexes.size() + attachmentIndexes.size() + metadataIndexes.size();
  for (const McapSchema& schema : schemas) size += schema.data.size() + schema.name.size() + 64;
  for (const McapChannel& channel : channels) {
    size += channel.topic.size() + 64;
    for (const auto& [key, value] : channel.metadata) size += key.size() + value.size() + 8;
  }
  return size;
}

McapChunk McapSummary::definitions() const {
  McapChunk chunk;
  for (const McapSchema& schema : schemas) chunk.add(schema);
  for (const McapChannel& channel : channels) chunk.add(channel);
  return chunk;
}

std::string McapSummary::records(std::uint64_t begin) const {
  struct Group {
    McapOp op;
    std::size_t start, length;
  };
  std::string text;
  std::vector<Group> groups;
  const auto group = [&](McapOp op, auto&& fill) {
    const std::size_t start = text.size();
    fill();
    if (text.size() > start) groups.push_back({op, start, text.size() - start});
  };
  group(McapOp::Schema, [&] {
    for (const auto& schema : schemas) putSchema(text, schema);
  });
  group(McapOp::Channel, [&] {
    for (const auto& channel : channels) putChannel(text, channel);
  });
  group(McapOp::ChunkIndex, [&] { text += chunkIndexes; });
  group(McapOp::AttachmentIndex, [&] { text += attachmentIndexes; });
  group(McapOp::MetadataIndex, [&] { text += metadataIndexes; });
  group(McapOp::Statistics, [&] {
    const auto record = beginRecord(text, McapOp::Statistics);
    putNumber(text, statistics.messages);
    putNumber(text, static_cast<std::uint16_t>(schemas.size()));
    putNumber(text, static_cast<std::uint32_t>(channels.size()));
    putNumber(text, attachments);
    putNumber(text, metadatas);
    putNumber(text, chunks);
    putNumber(text, statistics.start);
    putNumber(text, statistics.end);
    putNumber(text, static_cast<std::uint32_t>(statistics.perChannel.size() * 10));
    for (const auto& [channel, count] : statistics.perChannel) {
      putNumber(text, channel);
      putNumber(text, count);
    }
    endRecord(text, record);
  });
  const std::size_t offsets = text.size();
  for (const Group& g : groups) {
    const auto record = beginRecord(text, McapOp::SummaryOffset);
    text += static_cast<char>(g.op);
    putNumber(text, begin + g.start);
    putNumber(text, static_cast<std::uint64_t>(g.length));
    endRecord(text, record);
  }
  const auto footer = beginRecord(text, McapOp::Footer);
  putNumber(text, begin);
  putNumber(text, begin + offsets);
  // The checksum covers the footer's head, whose length is therefore written first.
  setNumber(text, footer - 8, static_cast<std::uint64_t>(footerLength));
  putNumber(text, extendedCrc(0, text));
  text.append(mcapMagic.data(), mcapMagic.size());
  return text;
}

namespace {

/// Room that is kept behind the file for the summary, beyond what the summary needs so far.
constexpr std::uint64_t spareRoom = 64 * kibibyte;

/// Who flushes the file at its end must not wait for all of it.
constexpr std::uint64_t bytesBetweenFlushes = 4 * mebibyte;

/// Chunks after which all definitions are repeated; in the beginning of a file more often.
constexpr std::uint64_t chunksBetweenRepeats = 64;

/// Adds schemas and channels that are not known by their numbers yet. Returns whether there were
/// any.
template <class Definition>
bool addNew(std::vector<Definition>& known, const std::vector<Definition>& definitions) {
  const std::size_t before = known.size();
  for (const Definition& definition : definitions) {
    const auto same = [&](const Definition& one) { return one.id == definition.id; };
    if (std::none_of(known.begin(), known.end(), same)) known.push_back(definition);
  }
  return known.size() > before;
}

}  // namespace

struct McapWriter::Impl {
  NewFile file;
  McapWriterOptions options;
  ZSTD_CCtx* compressor = nullptr;
  std::uint32_t dataCrc = 0;
  std::optional<Error> failed;
  std::uint64_t whole = 0;    ///< the file holds whole records up to here
  std::uint64_t flushed = 0;  ///< without options.sync: it is on its way to the disk up to here
  bool closed = false;

  std::string out;      ///< the record that is being written; of a chunk: what precedes its bytes
  std::string indexes;  ///< the message indexes behind it
  std::string compressed;
  McapSummary summary;
  std::uint64_t chunksGiven = 0;  ///< without those of repeated definitions
  bool defined = false;           ///< the last chunk brought definitions that stand only there
  std::optional<DiskSync> disk;   ///< with options.sync; last: it ends before the file is closed

  explicit Impl(NewFile f) : file(std::move(f)) {}
  ~Impl() { ZSTD_freeCCtx(compressor); }

  Result<void> fail(const Error& error) {
    failed = error;
    file.cutAt(whole);
    return tl::unexpected(error);
  }

  bool repeatIsDue() const {
    if (summary.schemas.empty() && summary.channels.empty()) return false;
    return defined || std::has_single_bit(chunksGiven) || chunksGiven % chunksBetweenRepeats == 0;
  }

  /// A part of what is written, and its checksum if that is known.
  struct Part {
    std::string_view bytes;
    std::optional<std::uint32_t> crc{};
  };
  /// Whole records of the data section.
  Result<void> write(std::initializer_list<Part> parts) {
    if (failed) return tl::unexpected(*failed);
    std::uint64_t size = 0;
    for (const Part& part : parts) size += part.bytes.size();
    const auto room = file.keepFreeSpace(size + summary.size() + spareRoom);
    if (!room) return fail(room.error());
    for (const Part& part : parts) {
      if (auto written = file.write(part.bytes); !written) return fail(written.error());
    }
    whole = file.size();
    if (!disk && whole - flushed >= bytesBetweenFlushes) {
      file.startFlush(flushed, whole - flushed);
      flushed = whole;
    }
    for (const Part& part : parts) {
      dataCrc = part.crc ? joinedCrc(dataCrc, *part.crc, part.bytes.size())
                         : extendedCrc(dataCrc, part.bytes);
    }
    return {};
  }

  Result<void> settle() {
    if (disk) {
      if (auto asked = disk->request(); !asked) return fail(asked.error());
    }
    if (auto there = file.stillThere(); !there) return fail(there.error());
    return {};
  }

  /// Returns the bytes of a chunk as they stand in the file.
  Result<std::string_view> pack(std::string_view body);
  bool isPlain() const { return options.level == McapWriterOptions::plainChunks; }
  const char* compression() const { return isPlain() ? "" : "zstd"; }
  void putMessageIndexes(const McapChunk& chunk, std::uint64_t offset,
                         std::vector<std::pair<std::uint16_t, std::uint64_t>>& places);
};

McapWriter::McapWriter(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
McapWriter::McapWriter(McapWriter&&) noexcept = default;
McapWriter& McapWriter::operator=(McapWriter&&) noexcept = default;
McapWriter::~McapWriter() = default;

Result<McapWriter> McapWriter::create(const std::string& path, const McapWriterOptions& options) {
  auto file = TRY(NewFile::create(path));
  return create(std::move(file), options);
}

Result<McapWriter> McapWriter::create(NewFile file, const McapWriterOptions& options) {
  auto impl = std::make_unique<Impl>(std::move(file));
  impl->options = options;
  if (options.sync) {
    impl->disk.emplace([&kept = impl->file, named = false]() mutable -> Result<void> {
      if (!std::exchange(named, true)) {
        TRY(kept.syncFolder());
      }
      return kept.sync();
    });
  }
  impl->compressor = ZSTD_createCCtx();
  ZSTD_CCtx_setParameter(impl->compressor, ZSTD_c_compressionLevel, options.level);
  std::string begin(mcapMagic.data(), mcapMagic.size());
  const auto record = beginRecord(begin, McapOp::Header);
  putText(begin, options.profile);
  putText(begin, options.library);
  endRecord(begin, record);
  TRY(impl->write({{begin}}));
  return McapWriter(std::move(impl));
}

Result<std::string_view> McapWriter::Impl::pack(std::string_view body) {
  if (isPlain()) return body;
  compressed.resize(ZSTD_compressBound(body.size()));
  const std::size_t size =
      ZSTD_compress2(compressor, compressed.data(), compressed.size(), body.data(), body.size());
  if (!ZSTD_isError(size)) return std::string_view(compressed).substr(0, size);
  (void)fail({ErrorCode::SystemError,
              std::string("The data cannot be compressed: ") + ZSTD_getErrorName(size) + ".",
              file.path()});
  return tl::unexpected(*failed);
}

/// One record per channel, in the order of the channels' numbers.
void McapWriter::Impl::putMessageIndexes(
    const McapChunk& chunk, std::uint64_t offset,
    std::vector<std::pair<std::uint16_t, std::uint64_t>>& places) {
  std::map<std::uint16_t, std::vector<const McapChunk::Entry*>> perChannel;
  for (const McapChunk::Entry& entry : chunk.m_index) perChannel[entry.channel].push_back(&entry);
  for (const auto& [channel, entries] : perChannel) {
    places.emplace_back(channel, offset + indexes.size());
    const auto record = beginRecord(indexes, McapOp::MessageIndex);
    putNumber(indexes, channel);
    putNumber(indexes, static_cast<std::uint32_t>(entries.size() * 16));
    for (const McapChunk::Entry* entry : entries) {
      putNumber(indexes, entry->logTime);
      putNumber(indexes, entry->offset);
    }
    endRecord(indexes, record);
  }
}

Result<void> McapWriter::writeChunk(const McapChunk& chunk) {
  Impl& impl = *m_impl;
  if (impl.failed) return tl::unexpected(*impl.failed);
  if (chunk.empty()) return {};
  if (impl.repeatIsDue()) {
    TRY(writeOne(impl.summary.definitions()));
    impl.defined = false;
  }
  ++impl.chunksGiven;
  return writeOne(chunk);
}

Result<void> McapWriter::writeOne(const McapChunk& chunk) {
  Impl& impl = *m_impl;
  std::uint64_t start = 0, end = 0;
  if (!chunk.m_index.empty()) {
    start = end = chunk.m_index.front().logTime;
    for (const McapChunk::Entry& entry : chunk.m_index) {
      start = std::min(start, entry.logTime);
      end = std::max(end, entry.logTime);
    }
  }
  const std::string_view packed = TRY(impl.pack(chunk.m_body));
  const std::uint32_t crc = extendedCrc(0, chunk.m_body);
  std::string& head = impl.out;
  head.clear();
  const auto record = beginRecord(head, McapOp::Chunk);
  putNumber(head, start);
  putNumber(head, end);
  putNumber(head, static_cast<std::uint64_t>(chunk.m_body.size()));
  putNumber(head, crc);
  putText(head, impl.compression());
  putNumber(head, static_cast<std::uint64_t>(packed.size()));
  const std::uint64_t length = head.size() + packed.size();
  setNumber(head, record - 8, length - record);
  const std::uint64_t offset = impl.file.size();
  std::string& indexes = impl.indexes;
  indexes.clear();
  std::vector<std::pair<std::uint16_t, std::uint64_t>> places;
  impl.putMessageIndexes(chunk, offset + length, places);
  const std::uint64_t indexLength = indexes.size();

  const std::uint32_t crcBefore = impl.dataCrc;
  const auto crcOfPacked = impl.isPlain() ? std::optional(crc) : std::nullopt;
  TRY(impl.write({{head}, {packed, crcOfPacked}, {indexes}}));
  if (auto settled = impl.settle(); !settled) {
    // The summary will not name this chunk, so it must not stand in the file either.
    impl.whole = offset;
    impl.dataCrc = crcBefore;
    impl.file.cutAt(offset);
    return settled;
  }

  ++impl.summary.chunks;
  std::string& index = impl.summary.chunkIndexes;
  const auto indexRecord = beginRecord(index, McapOp::ChunkIndex);
  for (const std::uint64_t value : {start, end, offset, length}) putNumber(index, value);
  putNumber(index, static_cast<std::uint32_t>(places.size() * 10));
  for (const auto& [channel, place] : places) {
    putNumber(index, channel);
    putNumber(index, place);
  }
  putNumber(index, indexLength);
  putText(index, impl.compression());
  putNumber(index, static_cast<std::uint64_t>(packed.size()));
  putNumber(index, static_cast<std::uint64_t>(chunk.m_body.size()));
  endRecord(index, indexRecord);

  const bool newSchemas = addNew(impl.summary.schemas, chunk.m_schemas);
  const bool newChannels = addNew(impl.summary.channels, chunk.m_channels);
  impl.defined = impl.defined || newSchemas || newChannels;
  McapStatistics& statistics = impl.summary.statistics;
  if (!chunk.m_index.empty()) {
    statistics.start = statistics.messages == 0 ? start : std::min(statistics.start, start);
    statistics.end = std::max(statistics.end, end);
  }
  statistics.messages += chunk.m_index.size();
  for (const McapChunk::Entry& entry : chunk.m_index) ++statistics.perChannel[entry.channel];
  return {};
}

Result<void> McapWriter::attach(std::uint64_t logTime, std::uint64_t createTime,
                                std::string_view name, std::string_view mediaType,
                                std::string_view data) {
  Impl& impl = *m_impl;
  std::string& out = impl.out;
  out.clear();
  const auto record = beginRecord(out, McapOp::Attachment);
  putNumber(out, logTime);
  putNumber(out, createTime);
  putText(out, name);
  putText(out, mediaType);
  putNumber(out, static_cast<std::uint64_t>(data.size()));
  out += data;
  putNumber(out, extendedCrc(0, std::string_view(out).substr(record)));
  endRecord(out, record);
  const std::uint64_t offset = impl.file.size();
  TRY(impl.write({{out}}));

  ++impl.summary.attachments;
  std::string& index = impl.summary.attachmentIndexes;
  const auto indexRecord = beginRecord(index, McapOp::AttachmentIndex);
  for (const std::uint64_t value : {offset, static_cast<std::uint64_t>(out.size()), logTime,
                                    createTime, static_cast<std::uint64_t>(data.size())}) {
    putNumber(index, value);
  }
  putText(index, name);
  putText(index, mediaType);
  endRecord(index, indexRecord);
  return {};
}

Result<void> McapWriter::metadata(std::string_view name, const McapMap& values) {
  Impl& impl = *m_impl;
  std::string& out = impl.out;
  out.clear();
  const auto record = beginRecord(out, McapOp::Metadata);
  putText(out, name);
  putMap(out, values);
  endRecord(out, record);
  const std::uint64_t offset = impl.file.size();
  TRY(impl.write({{out}}));

  ++impl.summary.metadatas;
  std::string& index = impl.summary.metadataIndexes;
  const auto indexRecord = beginRecord(index, McapOp::MetadataIndex);
  putNumber(index, offset);
  putNumber(index, static_cast<std::uint64_t>(out.size()));
  putText(index, name);
  endRecord(index, indexRecord);
  return {};
}

Result<void> McapWriter::sync() {
  return m_impl->settle();
}

Result<void> McapWriter::finish() {
  Impl& impl = *m_impl;
  if (std::exchange(impl.closed, true)) return {};
  std::string out;
  const auto record = beginRecord(out, McapOp::DataEnd);
  putNumber(out, impl.dataCrc);
  endRecord(out, record);
  out += impl.summary.records(impl.file.size() + out.size());
  auto written = impl.file.write(out);
  if (!written) {
    impl.file.cutAt(impl.whole);
  } else {
    impl.file.cutAt(impl.file.size());  // releases the reserved space
    if (impl.disk) written = impl.disk->finish();
  }
  impl.disk.reset();
  auto closed = impl.file.close();
  if (!written) return written;
  return closed;
}

std::uint64_t McapWriter::bytes() const {
  return m_impl->file.size();
}
double McapWriter::syncLatency() const {
  return m_impl->disk ? m_impl->disk->syncLatency() : 0.0;
}
const McapStatistics& McapWriter::statistics() const {
  return m_impl->summary.statistics;
}

}  // namespace pitchboard::telemetry
