// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sends small datagrams to one IPv4 address. It never blocks; datagrams that cannot be sent are
// counted. In this library only the monitor request uses it (tst_udp_receiver checks that), so that
// a program that only receives sends nothing. One thread at a time.

#include <cstdint>
#include <string_view>
#include <utility>

#include <base/unique_fd.h>
#include <telemetry/sockets/datagram.h>

namespace pitchboard::telemetry {

class UdpSender {
 public:
  /// Broadcast addresses are allowed.
  static Result<UdpSender> to(Address address);
  /// For simulated robots and referees: sends from `simulatedAddress` if the receiver is on the
  /// loopback network. Datagrams to other addresses can't be marked.
  static Result<UdpSender> simulatedTo(Address address);

  /// Sends to a port (1 to 65535). Returns whether the system accepted it; if not, errno tells why.
  /// Whether anybody receives it is unknown.
  bool send(std::uint16_t port, std::string_view datagram);
  std::uint64_t errors() const { return m_errors; }

 private:
  UdpSender(UniqueFd socket, Address address) : m_socket(std::move(socket)), m_address(address) {}

  UniqueFd m_socket;
  Address m_address;
  std::uint64_t m_errors = 0;
};

}  // namespace pitchboard::telemetry
