// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/sockets/udp_sender.h>

#include <cerrno>

#include <base/system_reason.h>
#include <base/try.h>
#include <telemetry/sockets/socket_address.h>

namespace pitchboard::telemetry {

Result<UdpSender> UdpSender::to(Address address) {
  UniqueFd socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!socket) {
    return failure(ErrorCode::SystemError, "cannot make a UDP socket: " + systemReason(errno));
  }
  const int yes = 1;
  if (::setsockopt(socket.get(), SOL_SOCKET, SO_BROADCAST, &yes, sizeof yes) != 0) {
    return failure(ErrorCode::SystemError,
                   "cannot allow broadcasts on a UDP socket: " + systemReason(errno));
  }
  return UdpSender(std::move(socket), address);
}

Result<UdpSender> UdpSender::simulatedTo(Address address) {
  auto sender = TRY(to(address));
  if (!isLoopback(address)) return sender;
  const sockaddr_in own = socketAddress(simulatedAddress, 0);
  if (::bind(sender.m_socket.get(), reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0) {
    return failure(ErrorCode::SystemError,
                   "Cannot send from " + simulatedAddress.text() + ": " + systemReason(errno) +
                       ". The loopback interface must have the network 127.0.0.0/8.");
  }
  return sender;
}

bool UdpSender::send(std::uint16_t port, std::string_view datagram) {
  const sockaddr_in receiver = socketAddress(m_address, port);
  const ssize_t sent = ::sendto(m_socket.get(), datagram.data(), datagram.size(), MSG_NOSIGNAL,
                                reinterpret_cast<const sockaddr*>(&receiver), sizeof receiver);
  if (sent == static_cast<ssize_t>(datagram.size())) return true;
  ++m_errors;
  return false;
}

}  // namespace pitchboard::telemetry
