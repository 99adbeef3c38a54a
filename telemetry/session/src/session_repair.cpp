// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/session/session_repair.h>

#include <zlib.h>
#include <cstdio>

#include <base/file_target.h>
#include <telemetry/mcap/mcap_cursor.h>
#include <telemetry/mcap/mcap_reader.h>
#include <telemetry/mcap/mcap_writer.h>
#include <telemetry/session/session_reader.h>

#include "session_format.h"
#include "session_loss.h"

namespace pitchboard::telemetry {
namespace {

/// What went in and what is read back must be the same: a checksum over every message in order.
class MessageDigest {
 public:
  void add(const McapMessage& message) {
    add(&message.channel, sizeof message.channel);
    add(&message.sequence, sizeof message.sequence);
    add(&message.logTime, sizeof message.logTime);
    add(&message.publishTime, sizeof message.publishTime);
    add(message.data.data(), message.data.size());
    ++m_count;
  }
  std::uint64_t count() const { return m_count; }
  bool operator==(const MessageDigest&) const = default;

 private:
  void add(const void* bytes, std::size_t size) {
    m_crc = crc32_z(m_crc, static_cast<const Bytef*>(bytes), size);
  }
  unsigned long m_crc = 0;
  std::uint64_t m_count = 0;
};

tl::unexpected<Error> stopped(const std::string& path) {
  return failure(ErrorCode::Conflict, "The repair was stopped.", path);
}

class Repair {
 public:
  Repair(const std::string& from, const std::string& to,
         const std::function<bool(double)>& progress)
      : m_from(from), m_to(to), m_progress(progress) {}

  Result<RepairReport> run() {
    auto target = FileTarget::at(m_to, IfExists::Refuse, m_from);
    if (!target) return tl::unexpected(target.error());
    McapReaderOptions options;
    if (m_progress) options.progress = [this](double part) { return m_progress(part * 0.4); };
    const auto session = SessionReader::open(m_from, options);
    if (!session) return tl::unexpected(session.error());
    const McapReader& broken = session->file();
    m_report.notes = broken.problems();
    m_report.brokeOff = !broken.ended();
    m_report.complete = !m_report.brokeOff;
    for (const McapLoss& loss : broken.losses()) note(loss, *session);
    if (broken.chunks().empty() && broken.metadata().empty() && broken.attachments().empty()) {
      return failure(ErrorCode::ParseError,
                     "Nothing in this file can be read; there is nothing to repair.", m_from);
    }
    auto file = target->open();
    if (!file) return tl::unexpected(file.error());
    auto created =
        McapWriter::create(std::move(*file), {broken.profile(), broken.library(), 3, true});
    if (!created) return tl::unexpected(created.error());
    auto done = fill(*session, *created);
    if (done) done = created->finish();
    if (done) done = verify(target->partPath());
    if (done) done = target->commit();
    if (!done) return tl::unexpected(done.error());
    m_report.bytes = created->bytes();
    return m_report;
  }

 private:
  void note(const McapLoss& loss, const SessionReader& session) {
    m_report.notes.push_back(lossText(loss, session.info().start));
    m_report.lostMessages += loss.messages.value_or(0);
    m_report.lostMore = m_report.lostMore || !loss.messages || loss.atLeast;
    m_report.complete = m_report.complete && loss.messages == 0U;
  }
  /// Something other than messages.
  void missing(std::string sentence) {
    m_report.notes.push_back(std::move(sentence));
    m_report.complete = false;
  }

  Result<void> fill(const SessionReader& session, McapWriter& out) {
    const McapReader& broken = session.file();
    for (const McapMetadataInfo& entry : broken.metadata()) {
      const auto values = broken.readMetadata(entry);
      if (!values) {
        missing(values.error().text());
        continue;
      }
      if (int format = 0;
          entry.name == session::metadataName && !session::infoFromMetadata(*values, format)) {
        missing("At byte " + std::to_string(entry.offset) +
                ": the description of the session is damaged.");
      }
      if (auto written = out.metadata(entry.name, *values); !written) return written;
    }
    for (const McapAttachmentInfo& entry : broken.attachments()) {
      const auto data = broken.readAttachment(entry);
      if (!data) {
        missing(data.error().text());
      } else if (auto written = out.attach(entry.logTime, entry.createTime, entry.name,
                                           entry.mediaType, *data);
                 !written) {
        return written;
      }
    }
    McapChunk chunk;
    for (const auto& [id, schema] : broken.schemas()) chunk.add(schema);
    for (const auto& [id, channel] : broken.channels()) chunk.add(channel);
    std::string body;
    std::uint64_t strangers = 0;
    for (std::size_t i = 0; i < broken.chunks().size(); ++i) {
      if (!report(0.4 +
                  0.4 * static_cast<double>(i) / static_cast<double>(broken.chunks().size()))) {
        return stopped(m_from);
      }
      if (auto read = broken.readChunk(broken.chunks()[i], body); !read) {
        note(broken.lossOf(broken.chunks()[i], read.error().message), session);
        continue;
      }
      McapCursor cursor(body);
      for (auto kind = cursor.next(); kind != McapCursor::Kind::End; kind = cursor.next()) {
        if (kind != McapCursor::Kind::Message) continue;
        if (!broken.channels().contains(cursor.message().channel)) {
          ++strangers;
          continue;
        }
        chunk.add(cursor.message());
        m_written.add(cursor.message());
      }
      if (auto written = out.writeChunk(chunk); !written) return written;
      chunk.clear();
    }
    if (strangers > 0) {
      missing(std::to_string(strangers) +
              (strangers == 1 ? " message belongs to a channel" : " messages belong to channels") +
              " whose description is lost.");
      m_report.lostMessages += strangers;
    }
    return out.writeChunk(chunk);
  }

  Result<void> verify(const std::string& path) {
    const auto wrong = [&](const std::string& why) {
      return failure(ErrorCode::SystemError,
                     "The new file does not hold what was written (" + why +
                         "); check the disk and try again.",
                     m_to);
    };
    auto made = McapReader::open(path);
    if (!made) return wrong(made.error().message);
    if (!made->indexed()) return wrong("its index is missing");
    MessageDigest found;
    std::string body;
    for (std::size_t i = 0; i < made->chunks().size(); ++i) {
      if (!report(0.8 +
                  0.2 * static_cast<double>(i) / static_cast<double>(made->chunks().size()))) {
        return stopped(m_from);
      }
      if (auto read = made->readChunk(made->chunks()[i], body); !read) {
        return wrong(read.error().message);
      }
      McapCursor cursor(body);
      for (auto kind = cursor.next(); kind != McapCursor::Kind::End; kind = cursor.next()) {
        if (kind == McapCursor::Kind::Message) found.add(cursor.message());
      }
    }
    if (found != m_written || made->statistics().messages != m_written.count()) {
      return wrong("its messages are others");
    }
    m_report.messages = found.count();
    m_report.seconds = static_cast<double>(made->statistics().end - made->statistics().start) / 1e9;
    return {};
  }

  bool report(double part) const { return !m_progress || m_progress(part); }

  const std::string& m_from;
  const std::string& m_to;
  const std::function<bool(double)>& m_progress;
  MessageDigest m_written;
  RepairReport m_report;
};

}  // namespace

std::string RepairReport::summary() const {
  char length[48];
  std::snprintf(length, sizeof length, "%.3f s", seconds);
  std::string text = std::to_string(messages) + " messages over " + length + " were saved";
  if (lostMessages > 0) {
    text += "; " + std::to_string(lostMessages) + (lostMessages == 1 ? " is lost" : " are lost");
    if (lostMore) text += ", and others that cannot be counted";
  } else if (lostMore) {
    text += "; others are lost that cannot be counted";
  } else if (brokeOff) {
    text += "; the recording broke off, so its end may be missing";
  } else if (!complete) {
    text += "; a part that is no message is missing";
  }
  return text + ".";
}

Result<RepairReport> repairSession(const std::string& from, const std::string& to,
                                   const std::function<bool(double)>& progress) {
  return Repair(from, to, progress).run();
}

}  // namespace pitchboard::telemetry
