// SPDX-License-Identifier: GPL-3.0-or-later
#include "udp_socket.h"

#include <cerrno>
#include <cstring>
#include <ctime>

#include <base/system_reason.h>
#include <telemetry/sockets/socket_address.h>

namespace pitchboard::telemetry {
namespace {

WallTime wallTime(const timespec& time) {
  return WallTime(std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec));
}

void setOption(int descriptor, int option, int value) {
  // Each of these options may fail; then less is known about the datagrams.
  (void)setsockopt(descriptor, SOL_SOCKET, option, &value, sizeof value);
}

std::string reason(int error) {
  switch (error) {
    case EADDRINUSE:
      return "another program is using it";
    case EADDRNOTAVAIL:
      return "no network interface of this computer has that address";
    case EACCES:
      return "ports below 1024 need administrator rights";
    default:
      return systemReason(error);
  }
}

}  // namespace

ReceiveBuffers::ReceiveBuffers()
    : bytes(std::make_unique_for_overwrite<char[]>(messages * messageBytes)) {}

void ReceiveBuffers::prepare() {
  for (std::size_t i = 0; i < messages; ++i) {
    vectors[i] = {bytes.get() + i * messageBytes, messageBytes};
    msghdr& head = heads[i].msg_hdr;
    head.msg_name = &senders[i];
    head.msg_namelen = sizeof senders[i];
    head.msg_iov = &vectors[i];
    head.msg_iovlen = 1;
    head.msg_control = controls[i].data();
    head.msg_controllen = controlBytes;
    head.msg_flags = 0;
  }
}

Result<UdpSocket> UdpSocket::bind(Address address, std::uint16_t port, int receiveBufferBytes,
                                  PortUse use) {
  const auto refused = [&](int error) {
    return failure(ErrorCode::SystemError, "Cannot receive on UDP port " + std::to_string(port) +
                                               ": " + reason(error) + ".");
  };
  UdpSocket socket;
  socket.m_fd = UniqueFd(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!socket.m_fd) return refused(errno);
  // With address reuse every listener on a port gets each broadcast, and the last one that was
  // started gets the unicast ones whole. SO_REUSEPORT would divide unicast among the listeners by
  // sender, so it is only set where the other listener has it and would be in the way otherwise.
  const int descriptor = socket.descriptor();
  if (use == PortUse::Shared) setOption(descriptor, SO_REUSEADDR, 1);
  const sockaddr_in name = socketAddress(address, port);
  const auto tryBind = [&] {
    return ::bind(descriptor, reinterpret_cast<const sockaddr*>(&name), sizeof name) == 0;
  };
  if (!tryBind()) {
    if (errno != EADDRINUSE || use == PortUse::First) return refused(errno);
    setOption(descriptor, SO_REUSEPORT, 1);
    if (!tryBind()) return refused(errno);
  }
  setOption(descriptor, SO_REUSEADDR, 1);
  setOption(descriptor, SO_RCVBUF, receiveBufferBytes);
  setOption(descriptor, SO_RCVBUFFORCE, receiveBufferBytes);
  setOption(descriptor, SO_TIMESTAMPNS, 1);
  setOption(descriptor, SO_RXQ_OVFL, 1);
  sockaddr_in bound{};
  socklen_t length = sizeof bound;
  if (getsockname(descriptor, reinterpret_cast<sockaddr*>(&bound), &length) != 0) {
    return refused(errno);
  }
  socket.m_port = ntohs(bound.sin_port);
  return socket;
}

std::size_t UdpSocket::receive(ReceiveBuffers& buffers, const LiveClock& clock,
                               DatagramBatch& batch, std::uint64_t& kernelDrops) {
  buffers.prepare();
  int count = 0;
  do {
    count = recvmmsg(m_fd.get(), buffers.heads.data(), ReceiveBuffers::messages, 0, nullptr);
  } while (count < 0 && errno == EINTR);
  if (count <= 0) return 0;
  const WallTime now = clock.now();
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    msghdr& head = buffers.heads[i].msg_hdr;
    DatagramView datagram;
    datagram.time = now;
    datagram.localPort = m_port;
    datagram.sender = {Address{ntohl(buffers.senders[i].sin_addr.s_addr)},
                       ntohs(buffers.senders[i].sin_port)};
    datagram.truncated = (head.msg_flags & MSG_TRUNC) != 0;
    for (cmsghdr* c = CMSG_FIRSTHDR(&head); c != nullptr; c = CMSG_NXTHDR(&head, c)) {
      if (c->cmsg_level != SOL_SOCKET) continue;
      if (c->cmsg_type == SCM_TIMESTAMPNS) {
        timespec stamp{};
        std::memcpy(&stamp, CMSG_DATA(c), sizeof stamp);
        datagram.time = clock.arrival(wallTime(stamp));
      } else if (c->cmsg_type == SO_RXQ_OVFL) {
        std::uint32_t drops = 0;
        std::memcpy(&drops, CMSG_DATA(c), sizeof drops);
        // The kernel's counter has 32 bits and may turn over.
        kernelDrops += drops - m_lastDrops;
        m_lastDrops = drops;
      }
    }
    datagram.payload = {static_cast<const char*>(buffers.vectors[i].iov_base),
                        buffers.heads[i].msg_len};
    batch.append(datagram);
  }
  return static_cast<std::size_t>(count);
}

}  // namespace pitchboard::telemetry
