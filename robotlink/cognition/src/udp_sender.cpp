// SPDX-License-Identifier: GPL-3.0-or-later
#include "udp_sender.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <cerrno>
#include <utility>

#include <base/system_reason.h>
#include <robotlink/processes/robot_config.h>
#include <telemetry/wire/datagram.h>

namespace pitchboard::link {

Result<UdpSender> UdpSender::to(const std::string& address) {
  const auto parsed = telemetry::parseAddress(address);
  if (!parsed) return tl::unexpected<Error>(parsed.error());
  const int fd = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (fd < 0) {
    return failure(ErrorCode::SystemError, "cannot make a UDP socket: " + systemReason(errno));
  }
  const int yes = 1;
  if (::setsockopt(fd, SOL_SOCKET, SO_BROADCAST, &yes, sizeof yes) != 0) {
    const int error = errno;
    ::close(fd);
    return failure(ErrorCode::SystemError,
                   "cannot allow broadcasts on a UDP socket: " + systemReason(error));
  }
  return UdpSender(fd, htonl(parsed->value));
}

UdpSender::UdpSender(UdpSender&& other) noexcept
    : m_socket(std::exchange(other.m_socket, -1)),
      m_address(other.m_address),
      m_errors(other.m_errors) {}

UdpSender& UdpSender::operator=(UdpSender&& other) noexcept {
  std::swap(m_socket, other.m_socket);
  std::swap(m_address, other.m_address);
  std::swap(m_errors, other.m_errors);
  return *this;
}

UdpSender::~UdpSender() {
  if (m_socket >= 0) ::close(m_socket);
}

bool UdpSender::send(int port, std::string_view datagram) {
  sockaddr_in receiver{};
  receiver.sin_family = AF_INET;
  receiver.sin_port = htons(static_cast<std::uint16_t>(port));
  receiver.sin_addr.s_addr = m_address;
  const ssize_t sent = ::sendto(m_socket, datagram.data(), datagram.size(), MSG_NOSIGNAL,
                                reinterpret_cast<const sockaddr*>(&receiver), sizeof receiver);
  if (sent == static_cast<ssize_t>(datagram.size())) return true;
  ++m_errors;
  return false;
}

}  // namespace pitchboard::link
