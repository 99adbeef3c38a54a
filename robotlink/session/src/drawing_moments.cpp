// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/drawing_moments.h>

#include <algorithm>
#include <array>

namespace pitchboard::link {
namespace {

using telemetry::SessionStream;

constexpr std::array telemetryOnly{SessionStream::Telemetry};
constexpr double longestLife = telemetry::DrawingLimits::longestLife;

std::size_t bytesOf(const LiveRecord& record) {
  constexpr std::size_t overhead = 128;
  return sizeof record + overhead + record.datagram.payload.size();
}

}  // namespace

std::vector<telemetry::RobotDrawings> DrawingMoments::at(const LiveHistory& history, double time) {
  // Nothing older than a layer can live matters.
  const bool goesOn = m_begun && time >= m_time && time - m_time <= longestLife;
  const double from = goesOn ? m_time : time - longestLife;
  if (!goesOn) m_book.clear();
  history.walk(telemetryOnly, {from, time}, [&](const LiveRecord& record) {
    if (goesOn && record.time <= from) return true;
    const telemetry::DatagramParts parts = telemetry::partsOf(record.datagram.payload);
    if (!parts.drawing.empty()) (void)m_book.take(parts.drawing, record.time);
    return true;
  });
  m_begun = true;
  m_time = time;
  return m_book.at(time);
}

LiveRecord drawingRecord(const HeardDrawing& drawing) {
  LiveRecord record;
  record.stream = SessionStream::Telemetry;
  record.time = drawing.time;
  record.datagram = {drawing.time, drawing.sender, drawing.port, drawing.text};
  return record;
}

// What a match that was put back had drawn after this moment is not its past.
void DrawingMemory::ticked(const SimulatedMatch& match, std::chrono::nanoseconds /*tickTime*/) {
  const sim::WorldState& state = match.simulation().state();
  const double now = static_cast<double>(state.tick) / state.settings.tickRate;
  const std::lock_guard lock(m_mutex);
  while (!m_records.empty() && m_records.back()->time > now) {
    m_bytes -= bytesOf(*m_records.back());
    m_records.pop_back();
  }
}

void DrawingMemory::drew(std::span<const HeardDrawing> drawings) {
  const std::lock_guard lock(m_mutex);
  for (const HeardDrawing& drawing : drawings) {
    m_records.push_back(std::make_shared<const LiveRecord>(drawingRecord(drawing)));
    m_bytes += bytesOf(*m_records.back());
  }
  while (m_bytes > m_room && m_records.size() > 1) {
    m_bytes -= bytesOf(*m_records.front());
    m_records.pop_front();
  }
}

double DrawingMemory::begin() const {
  const std::lock_guard lock(m_mutex);
  return m_records.empty() ? 0.0 : m_records.front()->time;
}

void DrawingMemory::walk(std::span<const SessionStream> streams, telemetry::TimeRange range,
                         const std::function<bool(const LiveRecord&)>& visit) const {
  if (std::ranges::find(streams, SessionStream::Telemetry) == streams.end()) return;
  std::vector<std::shared_ptr<const LiveRecord>> wanted;
  {
    const std::lock_guard lock(m_mutex);
    const auto time = [](const auto& record) { return record->time; };
    const auto first = std::ranges::lower_bound(m_records, range.begin, {}, time);
    const auto last = std::ranges::upper_bound(m_records, range.end, {}, time);
    if (first < last) wanted.assign(first, last);
  }
  for (const auto& record : wanted) {
    if (!visit(*record)) return;
  }
}

}  // namespace pitchboard::link
