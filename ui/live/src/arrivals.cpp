// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrivals.h"

#include <algorithm>
#include <mutex>
#include <tuple>

namespace pitchboard::ui {

class Arrivals::Keeper : public link::LiveObserver {
 public:
  void received(const link::LiveDatagram& datagram) override {
    if (datagram.variables == nullptr) take(datagram.view);
  }

  void take(const telemetry::DatagramView& datagram) {
    if (datagram.payload.size() > maxPayloadLength) return;
    const std::lock_guard lock(m_mutex);
    const auto known = std::ranges::find_if(m_arrivals, [&](const Arrival& one) {
      return one.sender.address == datagram.sender.address && one.localPort == datagram.localPort;
    });
    if (known == m_arrivals.end() && m_arrivals.size() == most) return;
    Arrival& arrival = known == m_arrivals.end() ? m_arrivals.emplace_back() : *known;
    arrival.time = datagram.time;
    arrival.sender = datagram.sender;
    arrival.localPort = datagram.localPort;
    arrival.payload = datagram.payload;
    ++arrival.count;
  }

  std::vector<Arrival> newest() const {
    const std::lock_guard lock(m_mutex);
    return m_arrivals;
  }

 private:
  mutable std::mutex m_mutex;
  std::vector<Arrival> m_arrivals;
};

Arrivals::Arrivals(LiveController* live) : m_live(live), m_keeper(std::make_shared<Keeper>()) {
  live->observe(m_keeper);
}

Arrivals::~Arrivals() {
  if (m_live) m_live->stopObserving(m_keeper);
}

void Arrivals::listenAt(const std::vector<std::uint16_t>& ports) {
  std::vector<std::uint16_t> wanted = ports;
  if (m_live) {
    for (const telemetry::PortStatus& port : m_live->details().network.ports) {
      std::erase(wanted, port.port);
    }
  }
  std::ranges::sort(wanted);
  if (wanted == m_ports) return;
  m_ports = std::move(wanted);
  // A port that is listened to twice may belong to the one who came last.
  m_receiver.reset();
  if (m_ports.empty() || !m_live) return;
  telemetry::ReceiverOptions options;
  options.bind = m_live->options().bind;
  options.ports = m_ports;
  options.yieldsToFirst = true;
  if (auto receiver = telemetry::UdpReceiver::start(std::move(options))) {
    m_receiver = std::move(*receiver);
  }
}

std::vector<Arrival> Arrivals::newest() {
  telemetry::DatagramBatch batch;
  while (m_receiver && m_receiver->take(batch)) {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const bool isSimulated = telemetry::isSimulated(batch[i].sender.address);
      if (!isSimulated || m_live->options().simulated) m_keeper->take(batch[i]);
    }
  }
  std::vector<Arrival> all = m_keeper->newest();
  std::ranges::sort(all, {}, [](const Arrival& one) {
    return std::tuple(one.localPort, one.sender.address.value);
  });
  return all;
}

}  // namespace pitchboard::ui
