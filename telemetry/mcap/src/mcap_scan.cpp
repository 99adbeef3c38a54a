// SPDX-License-Identifier: GPL-3.0-or-later
// Walks through a file that has no usable summary, record by record. Behind damage it looks for the
// next chunk that is whole.

#include <algorithm>
#include <optional>

#include <telemetry/mcap/mcap_cursor.h>

#include "mcap_bytes.h"
#include "mcap_reader_impl.h"

namespace pitchboard::telemetry {
namespace {

constexpr std::uint64_t longestLooseRun = 4U << 20;
constexpr std::uint64_t longestRecord = 64U << 20;  ///< of schemas, channels, metadata
constexpr int mostSearches = 64;
constexpr std::size_t searchStep = 1U << 20;
/// No recording unpacks to more than this many times its size; a file that does is made to harm.
constexpr std::uint64_t mostExpansion = 2000;
constexpr std::uint64_t freeExpansion = 256U << 20;

}  // namespace

class McapScan {
 public:
  explicit McapScan(McapReader::Impl& reader) : m_reader(reader), m_source(reader.source) {}

  bool run() {
    m_at = m_reader.dataBegin;
    std::uint64_t nextReport = 0;
    while (!m_done && m_at < m_source.size()) {
      if (m_reader.options.progress && m_at >= nextReport) {
        if (!m_reader.options.progress(static_cast<double>(m_at) /
                                       static_cast<double>(m_source.size()))) {
          return false;
        }
        nextReport = m_at + m_source.size() / 100;
      }
      step();
    }
    closeRun();
    boundLosses();
    if (!m_done && !m_told) {
      m_reader.problem(m_source.size(),
                       "the file ends without its end mark: the recording broke off.");
    }
    return true;
  }

 private:
  /// What was lost lies before the next message that was found.
  void boundLosses() {
    for (McapLoss& loss : m_reader.losses) {
      if (loss.end != 0) continue;
      const auto next = std::find_if(m_reader.chunks.begin(), m_reader.chunks.end(),
                                     [&loss](const McapChunkInfo& chunk) {
                                       return chunk.offset > loss.offset && chunk.end != 0;
                                     });
      if (next != m_reader.chunks.end() && !loss.messages) loss.end = next->start;
    }
  }

  void step() {
    const std::uint64_t left = m_source.size() - m_at;
    RecordReader in(m_source.look(m_at, recordHead));
    const auto op = in.number<std::uint8_t>();
    const auto length = in.number<std::uint64_t>();
    if (!in.ok() || op == 0 || length > left - recordHead) {
      closeRun();
      return search();
    }
    if (static_cast<McapOp>(op) == McapOp::Message) {
      addLoose(length);
    } else {
      closeRun();
      take(static_cast<McapOp>(op), length);
    }
    m_at += recordHead + length;
  }

  void take(McapOp op, std::uint64_t length) {
    switch (op) {
      case McapOp::Chunk:
        takeChunk(m_at, length, true);
        break;
      case McapOp::Attachment:
        takeAttachment(length);
        break;
      case McapOp::Metadata: {
        const std::string_view look =
            m_source.look(m_at + recordHead,
                          static_cast<std::size_t>(std::min<std::uint64_t>(length, longestHead)));
        RecordReader content(look);
        std::string name(content.text());
        if (content.ok()) m_reader.metadata.push_back({m_at, recordHead + length, std::move(name)});
        break;
      }
      case McapOp::Schema:
      case McapOp::Channel:
        if (length > longestRecord) {
          m_reader.problem(m_at, "a definition is too long; it is left out.");
        } else if (m_source.read(m_at, static_cast<std::size_t>(recordHead + length), m_body)) {
          takeBody(m_at, false);
        }
        break;
      case McapOp::DataEnd:
      case McapOp::Footer:
        m_done = true;
        break;
      default:
        break;
    }
  }

  void takeAttachment(std::uint64_t length) {
    const auto head = parseAttachmentHead(
        m_source.look(m_at + recordHead,
                      static_cast<std::size_t>(std::min<std::uint64_t>(length, longestHead))),
        length);
    if (!head) return m_reader.problem(m_at, "an attachment is damaged; it is left out.");
    McapAttachmentInfo info = head->info;
    info.offset = m_at;
    info.length = recordHead + length;
    m_reader.attachments.push_back(std::move(info));
  }

  /// True when the chunk is whole; `tell` what is wrong otherwise.
  bool takeChunk(std::uint64_t offset, std::uint64_t length, bool tell) {
    const auto head = parseChunkHead(
        m_source.look(offset + recordHead,
                      static_cast<std::size_t>(std::min<std::uint64_t>(length, 256))),
        length);
    if (!head) {
      if (tell) {
        m_reader.problem(offset, "this part is damaged: its head is not of its form.");
        m_reader.losses.push_back({offset, m_reader.statistics.end, 0, {}});
      }
      return false;
    }
    McapChunkInfo chunk = head->info;
    chunk.offset = offset;
    chunk.length = recordHead + length;
    if (auto read = m_reader.readChunk(chunk, m_body); !read) {
      if (tell) {
        m_reader.problem(offset, read.error().message);
        m_reader.losses.push_back(m_reader.lossOf(chunk));
      }
      return false;
    }
    m_unpacked += m_body.size();
    if (m_unpacked > freeExpansion && m_unpacked / mostExpansion > m_source.size()) {
      m_reader.problem(offset,
                       "the file unpacks to far more than any recording; the rest is left out.");
      m_done = m_told = true;
      return false;
    }
    chunk.channels = takeBody(offset, true);
    m_reader.chunks.push_back(std::move(chunk));
    return true;
  }

  /// Takes definitions and counts messages; the channels that have messages.
  std::vector<std::uint16_t> takeBody(std::uint64_t offset, bool chunk) {
    std::map<std::uint16_t, std::uint64_t> counts;
    McapCursor cursor(m_body);
    for (;;) {
      switch (cursor.next()) {
        case McapCursor::Kind::Schema:
          m_reader.schemas.insert({cursor.schema().id, cursor.schema()});
          continue;
        case McapCursor::Kind::Channel:
          m_reader.channels.insert({cursor.channel().id, cursor.channel()});
          continue;
        case McapCursor::Kind::Message: {
          const std::uint64_t time = cursor.message().logTime;
          McapStatistics& all = m_reader.statistics;
          all.start = all.messages == 0 ? time : std::min(all.start, time);
          all.end = std::max(all.end, time);
          ++all.messages;
          ++counts[cursor.message().channel];
          continue;
        }
        case McapCursor::Kind::End:
          break;
      }
      break;
    }
    if (cursor.damaged()) {
      m_reader.problem(offset, chunk ? "a part is whole but what is in it ends at its byte " +
                                           std::to_string(cursor.offset()) + "."
                                     : "a definition is damaged; it is left out.");
    }
    std::vector<std::uint16_t> channels;
    for (const auto& [channel, count] : counts) {
      channels.push_back(channel);
      m_reader.statistics.perChannel[channel] += count;
    }
    return channels;
  }

  void addLoose(std::uint64_t length) {
    if (m_run && m_at + recordHead + length - m_run->offset > longestLooseRun) closeRun();
    RecordReader in(m_source.look(m_at + recordHead, messageHead));
    const auto channel = in.number<std::uint16_t>();
    in.number<std::uint32_t>();
    const auto time = in.number<std::uint64_t>();
    if (!in.ok() || length < messageHead || length > m_reader.options.maxChunkBytes) {
      closeRun();
      return m_reader.problem(m_at, "a message is not of its form; it is left out.");
    }
    if (!m_run) {
      m_run.emplace();
      m_run->loose = true;
      m_run->offset = m_at;
      m_run->start = m_run->end = time;
    }
    m_run->length = m_at + recordHead + length - m_run->offset;
    m_run->compressedSize = m_run->uncompressedSize = m_run->length;
    m_run->start = std::min(m_run->start, time);
    m_run->end = std::max(m_run->end, time);
    auto& channels = m_run->channels;
    const auto place = std::lower_bound(channels.begin(), channels.end(), channel);
    if (place == channels.end() || *place != channel) channels.insert(place, channel);
    McapStatistics& all = m_reader.statistics;
    all.start = all.messages == 0 ? time : std::min(all.start, time);
    all.end = std::max(all.end, time);
    ++all.messages;
    ++all.perChannel[channel];
  }

  void closeRun() {
    if (m_run) m_reader.chunks.push_back(std::move(*m_run));
    m_run.reset();
  }

  /// The record at m_at is not one: finds the next whole chunk, or the end.
  void search() {
    const std::uint64_t from = m_at;
    // In a chunk's head the name of the compression stands behind these many bytes.
    constexpr std::uint64_t before = recordHead + 8 + 8 + 8 + 4;
    constexpr std::string_view mark{"\x04\0\0\0zstd", 8};
    std::uint64_t at = from + 1;
    while (m_searches < mostSearches && at < m_source.size()) {
      const std::string_view window = m_source.look(at, searchStep);
      const std::size_t found = window.find(mark);
      if (found == std::string_view::npos) {
        if (window.size() < mark.size() || at + window.size() >= m_source.size()) break;
        at += window.size() - mark.size() + 1;
        continue;
      }
      const std::uint64_t markAt = at + found;
      at = markAt + 1;
      if (markAt < from + 1 + before) continue;
      const std::uint64_t offset = markAt - before;
      RecordReader in(m_source.look(offset, recordHead));
      const auto op = in.number<std::uint8_t>();
      const auto length = in.number<std::uint64_t>();
      if (!in.ok() || op != static_cast<std::uint8_t>(McapOp::Chunk) ||
          length > m_source.size() - offset - recordHead) {
        continue;
      }
      ++m_searches;
      const std::uint64_t lastTime = m_reader.statistics.end;
      if (!takeChunk(offset, length, false)) {
        if (m_done) return;
        continue;
      }
      m_reader.problem(from, "the next " + std::to_string(offset - from) +
                                 " bytes are damaged; they are left out.");
      m_reader.losses.push_back({from, lastTime, 0, {}});
      m_at = offset + recordHead + length;
      return;
    }
    m_reader.problem(from, "the recording broke off here; the last " +
                               std::to_string(m_source.size() - from) +
                               " bytes are not whole and are left out.");
    m_done = m_told = true;
  }

  McapReader::Impl& m_reader;
  const McapSource& m_source;
  std::uint64_t m_at = 0;
  std::uint64_t m_unpacked = 0;
  std::optional<McapChunkInfo> m_run;
  std::string m_body;
  int m_searches = 0;
  bool m_done = false;
  bool m_told = false;
};

McapLoss McapReader::Impl::lossOf(const McapChunkInfo& chunk) const {
  McapLoss loss{chunk.offset, chunk.start, chunk.end, {}};
  if (chunk.end == 0) loss.messages = 0;  // definitions only
  // Behind a chunk stand the indexes of its messages, outside of its checksum and compression.
  std::uint64_t at = chunk.offset + chunk.length;
  for (;;) {
    RecordReader in(source.look(at, recordHead + 2 + 4));
    const auto op = in.number<std::uint8_t>();
    const auto length = in.number<std::uint64_t>();
    in.number<std::uint16_t>();
    const auto bytes = in.number<std::uint32_t>();
    if (!in.ok() || op != static_cast<std::uint8_t>(McapOp::MessageIndex) ||
        length > source.size() - at - recordHead || length != 2 + 4 + std::uint64_t{bytes}) {
      return loss;
    }
    loss.messages = loss.messages.value_or(0) + bytes / 16;
    at += recordHead + length;
  }
}

bool McapReader::Impl::scan() {
  return McapScan(*this).run();
}

}  // namespace pitchboard::telemetry
