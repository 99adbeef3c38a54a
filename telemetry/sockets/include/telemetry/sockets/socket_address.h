// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Converts addresses and ports to the form of the system's socket calls. Pure functions; any
// thread.

#include <netinet/in.h>
#include <sys/socket.h>

#include <telemetry/sockets/datagram.h>

namespace pitchboard::telemetry {

inline constexpr int highestPort = 65535;

/// Returns whether a port can be used; 0 (the system chooses) cannot.
constexpr bool isPort(int port) {
  return port >= 1 && port <= highestPort;
}

inline sockaddr_in socketAddress(Address address, std::uint16_t port) {
  sockaddr_in out{};
  out.sin_family = AF_INET;
  out.sin_port = htons(port);
  out.sin_addr.s_addr = htonl(address.value);
  return out;
}

}  // namespace pitchboard::telemetry
