// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/match/match_drawings.h>

namespace pitchboard::link {
namespace {

constexpr std::uint32_t thisComputer = 0x7f000001;
constexpr std::size_t maxWaiting = 4096, maxBytes = std::size_t{8} << 20;

}  // namespace

MatchDrawings::MatchDrawings(int port) {
  telemetry::ReceiverOptions options;
  options.bind = {thisComputer};
  options.ports = {static_cast<std::uint16_t>(port)};
  options.maxDatagrams = maxWaiting;
  options.maxBytes = maxBytes;
  auto receiver = telemetry::UdpReceiver::start(std::move(options));
  if (receiver) {
    m_receiver = std::move(*receiver);
  } else {
    m_problem = receiver.error().text();
  }
}

void MatchDrawings::receive(double time, std::vector<ReceivedDrawing>& out) {
  if (!m_receiver) return;
  if (!m_isBound) lookAtPort();
  if (!m_receiver->take(m_batch)) return;
  for (std::size_t i = 0; i < m_batch.size(); ++i) {
    const telemetry::DatagramView datagram = m_batch[i];
    // Of a message with a drawing behind it only the drawing concerns the match.
    const std::string_view drawing = telemetry::partsOf(datagram.payload).drawing;
    const std::string_view text = drawing.empty() ? datagram.payload : drawing;
    if (!m_store.take(text, time)) continue;
    out.push_back({time, datagram.sender, datagram.localPort, std::string(text)});
  }
}

void MatchDrawings::lookAtPort() {
  const telemetry::PortStatus port = m_receiver->status().ports.front();
  m_isBound = port.bound;
  m_problem = m_isBound ? std::string()
                        : "cannot receive drawings on UDP " + std::to_string(port.port) + ": " +
                              port.problem;
}

const std::string& MatchDrawings::problem() const {
  return m_problem.empty() ? m_store.lastProblem() : m_problem;
}

}  // namespace pitchboard::link
