// SPDX-License-Identifier: GPL-3.0-or-later
// What a session gives the studio, from any bytes: exact states of a match, the referee, events,
// and the moments of a live match (records: a byte for the stream, two for the length, then the
// bytes). The same bytes as a file: frames, statistics and the report.
#include <algorithm>
#include <cstdlib>

#include <robotlink/report/report.h>
#include <robotlink/session/live_recorder.h>
#include <robotlink/session/recorded_frame.h>
#include <robotlink/session/session_events.h>
#include <robotlink/session/state_codec.h>
#include <robotlink/session/state_segment.h>

using namespace pitchboard;
using telemetry::SessionStream;

namespace {

void states(std::string_view bytes) {
  std::string_view rest = bytes;
  if (const auto state = link::decodeState(rest)) {
    const std::string written = link::encodeState(*state);
    std::string_view all = written;
    const auto again = link::decodeState(all);
    if (!again || !all.empty() || link::encodeState(*again) != written) std::abort();
  }
  const auto segment = link::StateSegment::decode(bytes);
  if (!segment || segment->lastTick() - segment->firstTick() > 1000) return;
  (void)segment->at(segment->firstTick());
  (void)segment->at(segment->lastTick());
}

struct Records final : link::LiveHistory {
  std::vector<link::LiveRecord> all;

  explicit Records(std::string_view bytes) {
    constexpr SessionStream streams[] = {SessionStream::Telemetry, SessionStream::RefereeRaw,
                                         SessionStream::LiveState, SessionStream::Referee};
    while (bytes.size() > 3 && all.size() < 50) {
      const auto at = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
      link::LiveRecord& record = all.emplace_back();
      record.stream = streams[at(0) % std::size(streams)];
      record.time = 0.1 * static_cast<double>(all.size());
      const std::string_view body = bytes.substr(3, at(1) + 256U * at(2));
      record.datagram = {record.time, {{0x0a000001}, 5000}, 1241, std::string(body)};
      record.json = body;
      bytes.remove_prefix(3 + body.size());
    }
  }
  void walk(std::span<const SessionStream> streams, telemetry::TimeRange range,
            const std::function<bool(const link::LiveRecord&)>& visit) const override {
    for (const link::LiveRecord& record : all) {
      const bool wanted = std::find(streams.begin(), streams.end(), record.stream) != streams.end();
      if (!wanted || record.time < range.begin || record.time > range.end) continue;
      if (!visit(record)) return;
    }
  }
  double begin() const override { return 0.0; }
};

void moments(std::string_view bytes) {
  const Records records(bytes);
  link::LiveMoments live;
  for (const double time : {0.0, 0.35, 5.0, 0.2, 1e12}) {
    const auto frame = live.frameAt(records, time);
    const auto state = live.snapshotAt(records, time);
    if (frame.has_value() != state.has_value()) std::abort();
  }
}

void file(const std::string& bytes) {
  telemetry::McapReaderOptions options;
  options.maxChunkBytes = 1 << 20;
  options.maxAttachmentBytes = 1 << 20;
  const auto session = telemetry::SessionReader::openBytes(bytes, options);
  if (!session) return;
  const auto range = session->range();
  link::RecordedFrames frames(link::backdropOf(*session));
  for (const double time : {0.0, range ? range->begin : 1.0, range ? range->end : 2.0}) {
    (void)frames.frameAt(*session, time);
    (void)link::openingAt(*session, time);
  }
  if (!range || !(range->end - range->begin < 100.0)) return;
  link::ReportContent content;
  content.session = session->info();
  content.title = content.session.title;
  content.statistics = link::statisticsOf(*session, *range);
  content.events = link::eventsOf(*session);
  content.notes = session->notes();
  const std::string page = link::reportHtml(content);
  // The first script is the page's own, and the last.
  if (page.find("<script") != page.rfind("<script")) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  states(bytes);
  moments(bytes);
  file(bytes);
  return 0;
}
