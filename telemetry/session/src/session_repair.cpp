// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/session/session_repair.h>

#include <cstdio>

#include <base/file_target.h>
#include <telemetry/session/drawn_notes.h>
#include <telemetry/session/session_reader.h>

#include "session_copy.h"
#include "session_loss.h"
#include "session_summary.h"

namespace pitchboard::telemetry {
namespace {

tl::unexpected<Error> stopped(const std::string& path) {
  return failure(ErrorCode::Conflict, "The repair was stopped.", path);
}

class Repair {
 public:
  Repair(const std::string& from, const std::string& to,
         const std::function<bool(double)>& progress, IfExists ifExists)
      : m_from(from), m_to(to), m_progress(progress), m_ifExists(ifExists) {}

  Result<RepairReport> run() {
    auto target = FileTarget::at(m_to, m_ifExists, m_from);
    if (!target) return tl::unexpected(target.error());
    McapReaderOptions options;
    if (m_progress) options.progress = [this](double part) { return m_progress(part * 0.4); };
    const auto session = SessionReader::open(m_from, options);
    if (!session) return tl::unexpected(session.error());
    if (session->isGrowing()) {
      return failure(ErrorCode::Conflict,
                     "This file is still being recorded, so there is nothing to repair. Stop the "
                     "recording first.",
                     m_from);
    }
    const McapReader& broken = session->file();
    m_report.notes = broken.contents().problems;
    m_report.brokeOff = !broken.contents().ended;
    m_report.complete = !m_report.brokeOff;
    if (broken.contents().chunks.empty() && broken.contents().metadata.empty() &&
        broken.contents().attachments.empty()) {
      return failure(ErrorCode::ParseError,
                     "Nothing in this file can be read; there is nothing to repair.", m_from);
    }
    auto file = target->open();
    if (!file) return tl::unexpected(file.error());
    auto copied = copySession(
        *session, {}, std::move(*file),
        {broken.contents().profile, broken.contents().library, 3, true},
        [this](double part) { return report(0.4 + 0.4 * part); }, true);
    if (!copied) return m_stopped ? stopped(m_from) : tl::unexpected(copied.error());
    for (const McapLoss& loss : session->losses()) note(loss, *session);
    for (std::string& sentence : copied->missing) missing(std::move(sentence));
    if (const std::uint64_t lost = copied->messagesWithoutChannel; lost > 0) {
      missing(std::to_string(lost) +
              (lost == 1 ? " message belongs to a channel" : " messages belong to channels") +
              " whose definition is lost.");
      m_report.lostMessages += lost;
    }
    auto done = verify(target->partPath(), copied->channels);
    if (done) done = target->commit();
    if (done) done = copyDrawnNotes(m_from, m_to, {-1e18, 1e18});
    if (!done) return tl::unexpected(done.error());
    m_report.bytes = copied->bytes;
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

  Result<void> verify(const std::string& path,
                      const std::map<std::uint16_t, ChannelDigest>& written) {
    const auto wrong = [&](const std::string& why) {
      return failure(
          ErrorCode::SystemError,
          "The new file differs from what was written (" + why + "); check the disk and try again.",
          m_to);
    };
    auto made = SessionReader::open(path);
    if (!made) return wrong(made.error().message);
    if (!made->complete()) return wrong("its index is missing");
    std::map<std::uint16_t, ChannelDigest> found;
    const auto& channels = made->file().contents().channels;
    const bool whole = made->walkFile(
        {-1e18, 1e18},
        [&](const McapMessage& message) {
          const auto channel = channels.find(message.channel);
          const bool isSummary = channel != channels.end() &&
                                 channel->second.messageEncoding == session::summaryEncoding;
          if (isSummary) return true;
          found[message.channel].add(message);
          ++m_report.messages;
          return true;
        },
        [this](double part) { return report(0.8 + 0.2 * part); });
    if (!whole) return stopped(m_from);
    if (!made->losses().empty()) return wrong(made->losses().front().reason);
    if (found != written) return wrong("its messages differ");
    const McapStatistics& statistics = made->file().contents().statistics;
    m_report.seconds = static_cast<double>(statistics.end - statistics.start) / 1e9;
    return {};
  }

  bool report(double part) {
    m_stopped = m_progress && !m_progress(part);
    return !m_stopped;
  }

  const std::string& m_from;
  const std::string& m_to;
  const std::function<bool(double)>& m_progress;
  const IfExists m_ifExists;
  RepairReport m_report;
  bool m_stopped = false;
};

}  // namespace

std::string RepairReport::summary() const {
  char length[48];
  std::snprintf(length, sizeof length, "%.3f s", seconds);
  std::string text = std::to_string(messages) + " messages over " + length + " were saved";
  if (lostMessages > 0) {
    text += "; " + std::to_string(lostMessages) + (lostMore ? " and possibly more" : "") +
            (lostMessages == 1 && !lostMore ? " is lost" : " are lost");
  } else if (lostMore) {
    text += "; an unknown number of messages is lost";
  } else if (brokeOff) {
    text += "; the recording was cut off, so its end may be missing";
  } else if (!complete) {
    text += "; data other than messages is missing";
  }
  return text + ".";
}

Result<RepairReport> repairSession(const std::string& from, const std::string& to,
                                   const std::function<bool(double)>& progress, IfExists ifExists) {
  return Repair(from, to, progress, ifExists).run();
}

}  // namespace pitchboard::telemetry
