// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sends small datagrams to one IPv4 address. Never blocks; what cannot be sent is counted. In this
// library only the monitor request uses it (tst_udp_receiver checks that): listening stays silent.
// One thread at a time.

#include <cstdint>
#include <string_view>
#include <utility>

#include <base/unique_fd.h>
#include <telemetry/wire/datagram.h>

namespace pitchboard::telemetry {

class UdpSender {
 public:
  /// Broadcast addresses are allowed.
  static Result<UdpSender> to(Address address);

  /// Port 1..65535. Says whether the system took it, else errno tells why; a receiver need not
  /// exist.
  bool send(std::uint16_t port, std::string_view datagram);
  std::uint64_t errors() const { return m_errors; }

 private:
  UdpSender(UniqueFd socket, Address address) : m_socket(std::move(socket)), m_address(address) {}

  UniqueFd m_socket;
  Address m_address;
  std::uint64_t m_errors = 0;
};

}  // namespace pitchboard::telemetry
