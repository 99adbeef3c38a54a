// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sends the agent's datagrams to one receiver. Reports once that the network fails, and once that
// it works again. One thread at a time.

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include <telemetry/sockets/udp_sender.h>

namespace pitchboard::agent {

class Output {
 public:
  static Result<Output> to(telemetry::Address address, int port);

  /// Sends a datagram. Returns a message for the log, or an empty text. The network counts as
  /// working again after two seconds without a failure.
  std::string send(std::string_view datagram, std::chrono::microseconds now);
  const std::string& name() const { return m_name; }

 private:
  Output(telemetry::UdpSender sender, int port, std::string name)
      : m_sender(std::move(sender)), m_port(port), m_name(std::move(name)) {}

  telemetry::UdpSender m_sender;
  int m_port;
  std::string m_name;
  std::optional<std::chrono::microseconds> m_failed;  // the last time, until it works again
};

}  // namespace pitchboard::agent
