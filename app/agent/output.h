// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sends the agent's datagrams. Reports once when the network fails, and once when it works again.
// One thread.

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include <telemetry/wire/udp_sender.h>

namespace pitchboard::agent {

class Output {
 public:
  static Result<Output> to(telemetry::Address address, int port);

  /// Returns what a person should be told; empty: nothing. It works again when nothing has failed
  /// for two seconds.
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
