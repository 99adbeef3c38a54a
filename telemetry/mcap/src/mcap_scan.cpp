// SPDX-License-Identifier: GPL-3.0-or-later
// Walks through a file that has no usable summary, record by record. A record is believed if it may
// stand there and its lengths add up (mcap_form.h); behind damage the walk looks for the next one.
// Work is linear in the size of the file, whatever it holds.

#include <algorithm>
#include <optional>

#include <telemetry/mcap/mcap_cursor.h>

#include "mcap_bytes.h"
#include "mcap_form.h"
#include "mcap_reader_impl.h"

namespace pitchboard::telemetry {
namespace {

constexpr std::uint64_t maxLooseRunLength = 4U << 20;
constexpr std::size_t searchStep = 1U << 20;
/// No recording unpacks to more than this many times its size; a file that does is made to harm.
constexpr std::uint64_t maxExpansion = 2000;
constexpr std::uint64_t freeExpansion = 256U << 20;
/// What may be unpacked in vain at places that looked like chunks, in sizes of the file.
constexpr std::uint64_t maxRetries = 16;
constexpr std::uint64_t freeRetries = 64U << 20;

}  // namespace

class McapScan {
 public:
  explicit McapScan(McapReader::Impl& reader) : m_reader(reader), m_source(reader.source) {}

  bool run() {
    m_at = m_reader.dataBegin;
    m_retries = freeRetries + maxRetries * m_source.size();
    while (!m_done && m_at < m_source.size()) {
      if (!report(m_at)) return false;
      step();
      if (m_stopped) return false;
    }
    closeRun();
    m_reader.boundLosses();
    if (!m_done && !m_reader.growing) {
      m_reader.problem(m_source.size(), "the file has no end mark: the recording was cut off.");
    }
    return true;
  }

 private:
  bool report(std::uint64_t at) {
    if (!m_reader.options.progress || at < m_nextReport) return true;
    m_nextReport = at + m_source.size() / 100;
    m_stopped =
        !m_reader.options.progress(static_cast<double>(at) / static_cast<double>(m_source.size()));
    return !m_stopped;
  }

  void step() {
    const RecordHead head = headIn(m_source.look(m_at, recordHead));
    const std::uint64_t left = m_source.size() - m_at;
    if (!head.whole || head.length > left - recordHead || !take(head)) return search();
    if (m_done) return;
    // Behind a record of unknown kind nothing may stand that belongs to a chunk.
    m_last = isKnownRecord(head.op) ? head.op : McapOp::Header;
    m_at += recordHead + head.length;
  }

  /// False: there is no such record here.
  bool take(const RecordHead& head) {
    if (!isKnownRecord(head.op)) return passUnknown(head);
    const std::string_view beginning = contentAt(m_at, head.length);
    if (!mayFollow(m_last, head.op) || !formFits(head.op, beginning, head.length)) return false;
    if (head.op != McapOp::Message) closeRun();
    switch (head.op) {
      case McapOp::Message:
        return takeMessage(head.length, beginning);
      case McapOp::Chunk:
        return takeChunk(head.length, beginning);
      case McapOp::MessageIndex:
        m_indexDue -= std::min(m_indexDue, recordHead + head.length);
        return true;
      case McapOp::Schema:
      case McapOp::Channel:
        m_indexDue = 0;
        return m_source.read(m_at, static_cast<std::size_t>(recordHead + head.length), m_body) &&
               takeBody().whole;
      case McapOp::Attachment: {
        const auto attachment = parseAttachmentHead(beginning, head.length);
        if (!attachment) return false;
        m_indexDue = 0;
        m_reader.attachments.push_back(attachment->info);
        m_reader.attachments.back().offset = m_at;
        m_reader.attachments.back().length = recordHead + head.length;
        return true;
      }
      case McapOp::Metadata:
        m_indexDue = 0;
        m_reader.metadata.push_back(
            {m_at, recordHead + head.length, std::string(RecordReader(beginning).text())});
        return true;
      case McapOp::DataEnd:
        return m_done = m_reader.ended = dataEndsAt(m_source, m_at);
      case McapOp::Footer:
        return m_done = m_reader.ended = isFooter(m_at);
      default:
        return false;
    }
  }

  std::string_view contentAt(std::uint64_t record, std::uint64_t length) const {
    return m_source.look(record + recordHead,
                         static_cast<std::size_t>(std::min<std::uint64_t>(length, maxHeadLength)));
  }

  bool isFooter(std::uint64_t at) const {
    const auto footer = footerOf(m_source);
    return footer && footer->offset == at;
  }

  bool passUnknown(const RecordHead& head) {
    const std::uint64_t end = m_at + recordHead + head.length;
    if (head.op == McapOp{0} || !mayEnd(m_source, end, McapOp::Header)) return false;
    closeRun();
    m_indexDue = 0;
    lose({.offset = m_at, .bytes = end - m_at, .reason = "This record has an unknown type."});
    return true;
  }

  bool takeChunk(std::uint64_t length, std::string_view beginning) {
    const auto head = parseChunkHead(beginning, length);
    if (!head) return false;
    m_indexDue = 0;
    McapChunkInfo chunk = head->info;
    chunk.offset = m_at;
    chunk.length = recordHead + length;
    const std::uint64_t cost =
        std::min(chunk.uncompressedSize, McapReader::Impl::believedSize(length));
    const auto read = m_reader.readChunk(chunk, m_body);
    if (!read) {
      // What ends where no record does is no chunk, or not of this length.
      if (!mayEnd(m_source, m_at + chunk.length, McapOp::Chunk) && cost + length <= m_retries) {
        m_retries -= cost + length;
        return false;
      }
      lose(m_reader.lossOf(chunk, read.error().message));
    }
    m_unpacked += cost;
    if (m_unpacked > freeExpansion && m_unpacked / maxExpansion > m_source.size()) {
      lose({.offset = m_at,
            .bytes = m_source.size() - m_at,
            .reason = "The file decompresses to far more data than any recording has; the rest is "
                      "ignored."});
      return m_done = true;
    }
    if (!read) return true;
    const Body body = takeBody();
    chunk.start = body.start;
    chunk.end = body.end;
    for (const auto& [channel, count] : body.counts) {
      chunk.channels.push_back(channel);
      m_indexDue += recordHead + 2 + 4 + 16 * count;
    }
    if (!body.whole) {
      lose({.offset = m_at,
            .bytes = chunk.length,
            .start = chunk.start,
            .end = chunk.end,
            .reason = "This part ends in a truncated record."});
    }
    m_chunked = true;
    m_reader.chunks.push_back(std::move(chunk));
    return true;
  }

  struct Body {
    bool whole = false;
    std::uint64_t start = 0, end = 0;  ///< of its messages; 0 without
    std::map<std::uint16_t, std::uint64_t> counts;
  };

  /// Takes the definitions in m_body and counts its messages.
  Body takeBody() {
    Body body;
    McapCursor cursor(m_body);
    for (auto kind = cursor.next(); kind != McapCursor::Kind::End; kind = cursor.next()) {
      if (kind == McapCursor::Kind::Schema) {
        m_reader.schemas.insert({cursor.schema().id, cursor.schema()});
      } else if (kind == McapCursor::Kind::Channel) {
        m_reader.channels.insert({cursor.channel().id, cursor.channel()});
      } else {
        const std::uint64_t time = cursor.message().logTime;
        body.start = body.counts.empty() ? time : std::min(body.start, time);
        body.end = std::max(body.end, time);
        ++body.counts[cursor.message().channel];
        count(cursor.message().channel, time);
      }
    }
    body.whole = !cursor.damaged();
    return body;
  }

  void count(std::uint16_t channel, std::uint64_t time) {
    McapStatistics& all = m_reader.statistics;
    all.start = all.messages == 0 ? time : std::min(all.start, time);
    all.end = std::max(all.end, time);
    ++all.messages;
    ++all.perChannel[channel];
  }

  bool takeMessage(std::uint64_t length, std::string_view beginning) {
    const std::uint64_t end = m_at + recordHead + length;
    RecordReader in(beginning);
    const auto channel = in.number<std::uint16_t>();
    in.number<std::uint32_t>();
    const auto time = in.number<std::uint64_t>();
    // Where a chunk's index is due, what has the form of one is no message.
    if ((m_indexDue > 0 && formFits(McapOp::MessageIndex, beginning, length)) ||
        length > m_reader.options.maxChunkBytes || !mayEnd(m_source, end, McapOp::Message)) {
      return false;
    }
    m_indexDue = 0;
    if (m_run && end - m_run->offset > maxLooseRunLength) closeRun();
    if (!m_run) {
      m_run.emplace();
      m_run->loose = true;
      m_run->offset = m_at;
      m_run->start = m_run->end = time;
    }
    m_run->length = end - m_run->offset;
    m_run->compressedSize = m_run->uncompressedSize = m_run->length;
    m_run->start = std::min(m_run->start, time);
    m_run->end = std::max(m_run->end, time);
    auto& channels = m_run->channels;
    const auto place = std::lower_bound(channels.begin(), channels.end(), channel);
    if (place == channels.end() || *place != channel) channels.insert(place, channel);
    count(channel, time);
    return true;
  }

  void closeRun() {
    if (m_run) m_reader.chunks.push_back(std::move(*m_run));
    m_run.reset();
  }

  /// There is no record at m_at: goes to the next one, or to the end.
  void search() {
    closeRun();
    const std::uint64_t from = m_at;
    McapLoss loss{.offset = from, .reason = "This part is damaged."};
    bool found = false;
    m_at = from + 1;
    while (!found && m_at < m_source.size()) {
      if (!report(m_at)) return;
      const std::string_view window = m_source.look(m_at, searchStep);
      const bool last = window.size() < searchStep;
      // The beginning of every record that is looked at lies in the window.
      const std::size_t until = last ? window.size() : window.size() - maxHeadLength;
      std::size_t i = 0;
      RecordHead head;
      for (; i < until && !found; i += found ? 0 : 1) found = mayResume(window.substr(i), i, head);
      m_at += i;
      if (found && head.op == McapOp::MessageIndex) {
        // It tells what is lost; what stands behind it is looked at next.
        found = false;
        m_at = std::max(m_at + 1, m_reader.addIndexes(m_at, loss));
      }
      if (last && !found && i == window.size()) break;
    }
    if (!found) m_at = m_source.size();
    m_last = McapOp::Header;
    const std::uint64_t indexDue = std::exchange(m_indexDue, 0);
    loss.bytes = m_at - from;
    if (!found && m_reader.growing) {  // the rest of a record that is just being written
      m_done = true;
      return;
    }
    if (loss.bytes == indexDue || (!found && loss.bytes < indexDue)) {
      m_reader.problem(from, "an index of messages is damaged; no message is lost.");
      return;
    }
    loss.atLeast = loss.messages.has_value();
    if (!loss.messages) m_reader.lookAtHead(found, loss);
    if (!found && !loss.atLeast) {
      loss.reason = "The recording was cut off here.";
      m_done = true;
    }
    lose(std::move(loss));
  }

  /// Whether the walk can go on at `bytes`, `i` behind m_at, or finds an index there.
  bool mayResume(std::string_view bytes, std::size_t i, RecordHead& head) const {
    if (!mayFollow(McapOp::Chunk, static_cast<McapOp>(bytes.front()))) return false;
    head = headIn(bytes.substr(0, recordHead));
    const std::uint64_t at = m_at + i;
    if (!head.whole || head.length > m_source.size() - at - recordHead) return false;
    const std::string_view content = bytes.substr(
        recordHead, static_cast<std::size_t>(std::min<std::uint64_t>(head.length, maxHeadLength)));
    if (!formFits(head.op, content, head.length)) return false;
    switch (head.op) {
      case McapOp::Chunk:
        return true;
      case McapOp::MessageIndex:
        return head.length > 2 + 4;
      case McapOp::DataEnd:
        return dataEndsAt(m_source, at);
      case McapOp::Footer:
        return isFooter(at);
      case McapOp::Message:
        // In a chunk that is not packed, messages have no checksum of their own.
        if (m_chunked || !m_reader.channels.contains(RecordReader(content).number<std::uint16_t>()))
          return false;
        [[fallthrough]];
      default:
        return mayEnd(m_source, at + recordHead + head.length, head.op);
    }
  }

  /// Damage that several searches went through is one part, as long as nothing tells more of it.
  void lose(McapLoss loss) {
    const auto unknown = [](const McapLoss& one) {
      return !one.messages && one.start == 0 && one.end == 0;
    };
    auto& losses = m_reader.losses;
    if (!losses.empty() && losses.back().offset + losses.back().bytes == loss.offset &&
        losses.back().reason == loss.reason && unknown(losses.back()) && unknown(loss)) {
      losses.back().bytes += loss.bytes;
    } else {
      losses.push_back(std::move(loss));
    }
  }

  McapReader::Impl& m_reader;
  const McapSource& m_source;
  std::uint64_t m_at = 0;
  McapOp m_last = McapOp::Header;  ///< what stands in front of m_at
  std::uint64_t m_indexDue = 0;  ///< bytes of message indexes that the last chunk should have here
  std::uint64_t m_unpacked = 0, m_retries = 0, m_nextReport = 0;
  std::optional<McapChunkInfo> m_run;
  std::string m_body;
  bool m_chunked = false;  ///< there was a whole chunk
  bool m_done = false, m_stopped = false;
};

bool McapReader::Impl::scan() {
  return McapScan(*this).run();
}

}  // namespace pitchboard::telemetry
