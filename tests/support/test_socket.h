// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A UDP socket on 127.0.0.1 for tests: sends, and hears whether anybody sends back.

#include <cstdint>
#include <string>
#include <string_view>

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

/// Bound to a free port of 127.0.0.1, or to the one that is asked for. What is sent there is in its
/// queue when send() has returned.
class TestSocket {
 public:
  explicit TestSocket(std::uint32_t address = INADDR_LOOPBACK, int port = 0) {
    m_fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_in name = at(address, static_cast<std::uint16_t>(port));
    socklen_t length = sizeof name;
    m_good = bind(m_fd, reinterpret_cast<sockaddr*>(&name), length) == 0 &&
             getsockname(m_fd, reinterpret_cast<sockaddr*>(&name), &length) == 0;
    m_port = ntohs(name.sin_port);
    const int on = 1;
    setsockopt(m_fd, SOL_SOCKET, SO_BROADCAST, &on, sizeof on);
  }
  ~TestSocket() { close(m_fd); }
  TestSocket(const TestSocket&) = delete;
  TestSocket& operator=(const TestSocket&) = delete;

  bool good() const { return m_good; }
  std::uint16_t port() const { return m_port; }
  int descriptor() const { return m_fd; }

  bool send(std::uint16_t port, std::string_view text,
            std::uint32_t address = INADDR_LOOPBACK) const {
    const sockaddr_in to = at(address, port);
    return sendto(m_fd, text.data(), text.size(), 0, reinterpret_cast<const sockaddr*>(&to),
                  sizeof to) == static_cast<ssize_t>(text.size());
  }
  /// The next datagram, or nothing.
  std::string take() const {
    char buffer[2000];
    const ssize_t got = recv(m_fd, buffer, sizeof buffer, MSG_DONTWAIT);
    return got < 0 ? std::string() : std::string(buffer, static_cast<std::size_t>(got));
  }
  /// True when something has been received.
  bool received() const {
    char byte;
    return recv(m_fd, &byte, 1, MSG_DONTWAIT | MSG_PEEK) >= 0;
  }

  static sockaddr_in at(std::uint32_t address, std::uint16_t port) {
    sockaddr_in out{};
    out.sin_family = AF_INET;
    out.sin_port = htons(port);
    out.sin_addr.s_addr = htonl(address);
    return out;
  }

 private:
  int m_fd = -1;
  std::uint16_t m_port = 0;
  bool m_good = false;
};
