// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/live_memory.h>

#include <algorithm>
#include <vector>

#include <robotlink/session/live_recorder.h>

namespace pitchboard::link {
namespace {

using telemetry::SessionStream;

constexpr double disorder = 2.0;  // s; threads and ports may swap records within this
constexpr std::size_t overhead = 128;

std::size_t bytesOf(const LiveRecord& record) {
  return sizeof record + overhead + record.json.size() + record.datagram.payload.size();
}

}  // namespace

void LiveRecords::received(const LiveDatagram& datagram) {
  if (datagram.isFromRefusedSender() || datagram.variables != nullptr)
    return;  // variables are rows
  LiveRecord record;
  record.stream = datagram.referee ? SessionStream::RefereeRaw : SessionStream::Telemetry;
  record.time = datagram.time;
  record.datagram = {datagram.time, datagram.view.sender, datagram.view.localPort,
                     std::string(datagram.view.payload)};
  keep(std::move(record));
  if (const telemetry::RefereeState* state = datagram.state()) m_refereeNews = *state;
}

void LiveRecords::frameMade(const MatchFrame& frame) {
  const auto news = std::exchange(m_refereeNews, std::nullopt);
  if (!frame.game || !news) return;
  const double time = frame.snapshot.time;
  LiveRecord record;
  record.stream = SessionStream::Referee;
  record.time = time;
  record.json = refereeToJson(*news, frame);
  keep(std::move(record));
}

void LiveRecords::remembered(double time, std::string_view state) {
  LiveRecord record;
  record.stream = SessionStream::LiveState;
  record.time = time;
  record.json = state;
  keep(std::move(record));
}

void RecordMemory::remember(LiveRecord record) {
  auto kept = std::make_shared<const LiveRecord>(std::move(record));
  const std::lock_guard lock(m_mutex);
  m_bytes += bytesOf(*kept);
  m_records.push_back(std::move(kept));
  while (m_bytes > m_room && m_records.size() > 1) {
    m_bytes -= bytesOf(*m_records.front());
    m_records.pop_front();
  }
}

void RecordMemory::forgetAfter(double time) {
  const std::lock_guard lock(m_mutex);
  while (!m_records.empty() && m_records.back()->time > time) {
    m_bytes -= bytesOf(*m_records.back());
    m_records.pop_back();
  }
}

double RecordMemory::begin() const {
  const std::lock_guard lock(m_mutex);
  return m_records.empty() ? 0.0 : m_records.front()->time;
}

void RecordMemory::walk(std::span<const SessionStream> streams, telemetry::TimeRange range,
                        const std::function<bool(const LiveRecord&)>& visit) const {
  std::vector<Kept> wanted;
  {
    const std::lock_guard lock(m_mutex);
    const auto first =
        std::lower_bound(m_records.begin(), m_records.end(), range.begin - disorder,
                         [](const Kept& record, double time) { return record->time < time; });
    for (auto record = first; record != m_records.end(); ++record) {
      if ((*record)->time > range.end + disorder) break;
      if ((*record)->time < range.begin || (*record)->time > range.end) continue;
      if (std::ranges::find(streams, (*record)->stream) != streams.end()) wanted.push_back(*record);
    }
  }
  for (const Kept& record : wanted) {
    if (!visit(*record)) return;
  }
}

}  // namespace pitchboard::link
