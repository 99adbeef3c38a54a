// SPDX-License-Identifier: GPL-3.0-or-later
// The datagrams' way over the loopback device.
#include <base/try.h>
#include <robotlink/cognition/cognition_debug.h>

#include <cerrno>
#include <utility>

#include <base/system_reason.h>
#include <telemetry/sockets/socket_address.h>

namespace pitchboard::link {
namespace {

constexpr std::size_t maxDatagramLength = 65536;
constexpr int maxPerPoll = 1000;  // a flood must not hold the display up
constexpr std::chrono::seconds debugMemory{3};

Result<void> checkPort(int port, int least) {
  if (port >= least && port <= telemetry::highestPort) return {};
  return failure(ErrorCode::InvalidArgument, "the port for cognition debug data is " +
                                                 std::to_string(port) + ", allowed are 1 to 65535");
}

}  // namespace

Result<CognitionDebugSender> CognitionDebugSender::to(int port) {
  if (const Result<void> valid = checkPort(port, 1); !valid)
    return tl::unexpected<Error>(valid.error());
  auto sender = TRY(telemetry::UdpSender::to({INADDR_LOOPBACK}));
  return CognitionDebugSender(std::move(sender), static_cast<std::uint16_t>(port));
}

void CognitionDebugSender::send(const CognitionDebug& cognitionDebug) {
  for (const std::string& datagram : debugDatagrams(cognitionDebug)) {
    (void)m_sender.send(m_port, datagram);
  }
}

Result<CognitionDebugReceiver> CognitionDebugReceiver::listen(int port) {
  if (const Result<void> valid = checkPort(port, 0); !valid)
    return tl::unexpected<Error>(valid.error());
  UniqueFd socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!socket) {
    return failure(ErrorCode::SystemError, "cannot make a UDP socket: " + systemReason(errno));
  }
  const int fd = socket.get();
  constexpr int roomForRobots = 1 << 21;
  (void)::setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &roomForRobots, sizeof roomForRobots);
  sockaddr_in name = telemetry::socketAddress({INADDR_LOOPBACK}, static_cast<std::uint16_t>(port));
  socklen_t size = sizeof name;
  if (::bind(fd, reinterpret_cast<const sockaddr*>(&name), sizeof name) != 0 ||
      ::getsockname(fd, reinterpret_cast<sockaddr*>(&name), &size) != 0) {
    return failure(ErrorCode::SystemError,
                   "port " + std::to_string(port) +
                       " for cognition debug data cannot be opened: " + systemReason(errno));
  }
  CognitionDebugReceiver receiver(std::move(socket), ntohs(name.sin_port));
  receiver.m_buffer.resize(maxDatagramLength);
  return receiver;
}

void CognitionDebugReceiver::poll(Time now) {
  for (int i = 0; i < maxPerPoll; ++i) {
    const ssize_t size = ::recv(m_socket.get(), m_buffer.data(), m_buffer.size(), 0);
    if (size < 0) break;
    CognitionDebug message;
    if (!readDebugDatagram({m_buffer.data(), static_cast<std::size_t>(size)}, message)) {
      ++m_strange;
      continue;
    }
    Received& received = m_received[message.robot];
    received.cognitionDebug.robot = message.robot;
    if (message.cloud) {
      received.cognitionDebug.cloud = std::move(message.cloud);
      received.cloudTime = now;
    }
    if (message.path) {
      received.cognitionDebug.path = std::move(message.path);
      received.pathTime = now;
    }
  }
}

std::vector<CognitionDebug> CognitionDebugReceiver::cognitionDebug(Time now) const {
  const auto age = [now](Time then) { return std::chrono::duration<double>(now - then).count(); };
  std::vector<CognitionDebug> all;
  for (const auto& [robot, received] : m_received) {
    CognitionDebug newest = received.cognitionDebug;
    newest.cloudAge = age(received.cloudTime);
    newest.pathAge = age(received.pathTime);
    if (now - received.cloudTime > debugMemory) newest.cloud.reset();
    if (now - received.pathTime > debugMemory) newest.path.reset();
    if (newest.cloud || newest.path) all.push_back(std::move(newest));
  }
  return all;
}

}  // namespace pitchboard::link
