// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Receives the drawings of a simulated match: datagrams from programs on this computer to the
// match's drawing port on 127.0.0.1 (docs/drawings.md), stamped with the match's time in s. It
// never changes the match. SimulatedMatch owns and calls it; the socket has a thread of its own.

#include <memory>
#include <string>
#include <vector>

#include <telemetry/drawings/drawing_store.h>
#include <telemetry/sockets/udp_receiver.h>

namespace pitchboard::link {

/// A datagram with a drawing, as it arrived.
struct ReceivedDrawing {
  double time = 0.0;  ///< s of the match
  telemetry::Sender sender;
  std::uint16_t port = 0;
  std::string text;
};

class MatchDrawings {
 public:
  /// Starts receiving. If the port is in use, it is tried again, and problem() says so.
  explicit MatchDrawings(int port);

  /// Takes the datagrams since the last call and stamps them with this time. Never waits.
  void receive(double time, std::vector<ReceivedDrawing>& out);
  const telemetry::DrawingStore& store() const { return m_store; }
  /// Returns why nothing is received or the last drawing was refused; empty if all is well.
  const std::string& problem() const;

 private:
  void lookAtPort();

  std::unique_ptr<telemetry::UdpReceiver> m_receiver;
  bool m_isBound = false;
  telemetry::DatagramBatch m_batch;
  telemetry::DrawingStore m_store;
  std::string m_problem;
};

}  // namespace pitchboard::link
