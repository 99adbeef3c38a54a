// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What programs of this computer draw on the field of a simulated match: datagrams to the match's
// drawing port on 127.0.0.1 (docs/drawings.md), stamped with the match's time. It changes nothing
// in the match. Owned by the SimulatedMatch, on its thread; the socket has a thread of its own.

#include <memory>
#include <string>
#include <vector>

#include <telemetry/wire/drawing_store.h>
#include <telemetry/wire/udp_receiver.h>

namespace pitchboard::link {

/// A datagram with a drawing in it, as it came.
struct ReceivedDrawing {
  double time = 0.0;  ///< s of the match
  telemetry::Sender sender;
  std::uint16_t port = 0;
  std::string text;
};

class MatchDrawings {
 public:
  /// A port that is taken is tried again; problem() says so.
  explicit MatchDrawings(int port);

  /// Takes what has come since the last call, as of this time; never waits.
  void hear(double time, std::vector<ReceivedDrawing>& out);
  const telemetry::DrawingStore& store() const { return m_store; }
  /// Why nothing is heard, or the last drawing was refused; empty: all is well.
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
