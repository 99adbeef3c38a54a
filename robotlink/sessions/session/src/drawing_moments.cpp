// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/drawing_moments.h>

#include <array>

namespace pitchboard::link {
namespace {

using telemetry::SessionStream;

constexpr std::array telemetryOnly{SessionStream::Telemetry};
constexpr double maxLife = telemetry::DrawingLimits::maxLife;

}  // namespace

std::vector<telemetry::RobotDrawings> DrawingMoments::at(const LiveHistory& history, double time) {
  // Nothing older than a layer can live matters.
  const bool goesOn = m_begun && time >= m_time && time - m_time <= maxLife;
  const double from = goesOn ? m_time : time - maxLife;
  if (!goesOn) m_store.clear();
  history.walk(telemetryOnly, {from, time}, [&](const LiveRecord& record) {
    if (goesOn && record.time <= from) return true;
    const telemetry::DatagramParts parts = telemetry::partsOf(record.datagram.payload);
    if (!parts.drawing.empty()) (void)m_store.take(parts.drawing, record.time);
    return true;
  });
  m_begun = true;
  m_time = time;
  return m_store.at(time);
}

LiveRecord drawingRecord(const ReceivedDrawing& drawing) {
  LiveRecord record;
  record.stream = SessionStream::Telemetry;
  record.time = drawing.time;
  record.datagram = {drawing.time, drawing.sender, drawing.port, drawing.text};
  return record;
}

void DrawingMemory::ticked(const SimulatedMatch& match, std::chrono::nanoseconds /*tickTime*/) {
  const sim::WorldState& state = match.simulation().state();
  forgetAfter(static_cast<double>(state.tick) / state.settings.tickRate);
}

void DrawingMemory::drew(std::span<const ReceivedDrawing> drawings) {
  for (const ReceivedDrawing& drawing : drawings) remember(drawingRecord(drawing));
}

}  // namespace pitchboard::link
