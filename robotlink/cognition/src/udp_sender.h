// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sends small datagrams to one IPv4 address. Never blocks; what cannot be sent is counted.

#include <cstdint>
#include <string>
#include <string_view>

#include <base/result.h>

namespace pitchboard::link {

/// One thread at a time.
class UdpSender {
 public:
  /// `address` in dotted form; broadcast addresses are allowed. Fails for anything else.
  static Result<UdpSender> to(const std::string& address);
  UdpSender(UdpSender&& other) noexcept;
  UdpSender& operator=(UdpSender&& other) noexcept;
  ~UdpSender();

  /// Port 1..65535. Says whether the system took it; a receiver need not exist.
  bool send(int port, std::string_view datagram);
  std::uint64_t errors() const { return m_errors; }

 private:
  UdpSender(int socket, std::uint32_t address) : m_socket(socket), m_address(address) {}

  int m_socket = -1;
  std::uint32_t m_address = 0;  // network byte order
  std::uint64_t m_errors = 0;
};

}  // namespace pitchboard::link
