// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The last datagram of everybody who sends to the robots' ports, used or not, for the preview of
// team setups: also on ports of a setup that is only being edited, which Live does not listen to
// yet. Nothing is sent. UI thread; Live's thread hands datagrams over.

#include <QPointer>
#include <memory>
#include <string>
#include <vector>

#include <telemetry/sockets/udp_receiver.h>
#include <ui/sources/live_controller.h>

namespace pitchboard::ui {

struct Arrival {
  telemetry::WallTime time;
  telemetry::Sender sender;
  std::uint16_t localPort = 0;
  std::uint64_t count = 0;  ///< from this address to this port
  std::string payload;      ///< of the last one

  telemetry::DatagramView view() const { return {time, sender, localPort, false, payload}; }
};

class Arrivals {
 public:
  static constexpr std::size_t most = 64;
  static constexpr std::size_t maxPayloadLength = 4096;  ///< longer ones are not kept

  explicit Arrivals(LiveController* live);
  ~Arrivals();
  Arrivals(const Arrivals&) = delete;
  Arrivals& operator=(const Arrivals&) = delete;

  /// Ports that are wanted besides those of Live.
  void listenAt(const std::vector<std::uint16_t>& ports);
  /// What has come since the beginning, by sender and port.
  std::vector<Arrival> newest();

 private:
  class Keeper;
  QPointer<LiveController> m_live;
  std::shared_ptr<Keeper> m_keeper;
  std::vector<std::uint16_t> m_ports;
  std::unique_ptr<telemetry::UdpReceiver> m_receiver;
};

}  // namespace pitchboard::ui
