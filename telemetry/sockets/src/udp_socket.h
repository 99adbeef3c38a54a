// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sockets that only receive, with the kernel's time stamps and its count of what it had to drop.
// They belong to the thread of UdpReceiver.

#include <array>
#include <memory>

#include <netinet/in.h>
#include <sys/socket.h>

#include <base/unique_fd.h>
#include <telemetry/sockets/datagram.h>
#include <telemetry/sockets/live_clock.h>

namespace pitchboard::telemetry {

/// Memory for one recvmmsg() call; one for all sockets. Only the pages that datagrams really reach
/// are ever touched.
struct ReceiveBuffers {
  static constexpr std::size_t messages = 64;
  static constexpr std::size_t messageBytes = 65536;  ///< more than a UDP datagram can have
  static constexpr std::size_t controlBytes = 128;

  ReceiveBuffers();
  void prepare();

  std::unique_ptr<char[]> bytes;
  std::array<mmsghdr, messages> heads{};
  std::array<iovec, messages> vectors{};
  std::array<sockaddr_in, messages> senders{};
  alignas(cmsghdr) std::array<std::array<char, controlBytes>, messages> controls{};
};

/// How a port is shared with other programs of this computer. The kernel hands broadcasts to all of
/// them, but each other datagram to one: the one that bound the port last.
enum class PortUse : std::uint8_t {
  Shared,  ///< takes datagrams away from programs that came before
  First    ///< fails if another program has the port; later ones can share it
};

/// A bound, non-blocking UDP socket that only receives.
class UdpSocket {
 public:
  /// Error SystemError with the reason in a sentence.
  static Result<UdpSocket> bind(Address address, std::uint16_t port, int receiveBufferBytes,
                                PortUse use);

  int descriptor() const { return m_fd.get(); }
  std::uint16_t port() const { return m_port; }

  /// Appends up to ReceiveBuffers::messages datagrams to `batch`. Returns how many came; fewer than
  /// asked for means that the socket is empty. `kernelDrops` is the kernel's count since the bind.
  std::size_t receive(ReceiveBuffers& buffers, const LiveClock& clock, DatagramBatch& batch,
                      std::uint64_t& kernelDrops);

 private:
  UniqueFd m_fd;
  std::uint16_t m_port = 0;
  std::uint32_t m_lastDrops = 0;
};

}  // namespace pitchboard::telemetry
