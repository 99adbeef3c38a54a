// SPDX-License-Identifier: GPL-3.0-or-later
// The datagrams' way over the loopback device.
#include <base/try.h>
#include <robotlink/cognition/robot_thoughts.h>

#include <cerrno>
#include <utility>

#include <base/system_reason.h>
#include <telemetry/wire/socket_address.h>

namespace pitchboard::link {
namespace {

constexpr std::size_t longestDatagram = 65536;
constexpr int mostPerPoll = 1000;  // a flood must not hold the display up
constexpr std::chrono::seconds memory{3};

Result<void> checkPort(int port, int least) {
  if (port >= least && port <= telemetry::highestPort) return {};
  return failure(ErrorCode::InvalidArgument,
                 "the port for thoughts is " + std::to_string(port) + ", allowed are 1 to 65535");
}

}  // namespace

Result<ThoughtsSender> ThoughtsSender::to(int port) {
  if (const Result<void> valid = checkPort(port, 1); !valid)
    return tl::unexpected<Error>(valid.error());
  auto sender = TRY(telemetry::UdpSender::to({INADDR_LOOPBACK}));
  return ThoughtsSender(std::move(sender), static_cast<std::uint16_t>(port));
}

void ThoughtsSender::send(const RobotThoughts& thoughts) {
  for (const std::string& datagram : thoughtDatagrams(thoughts)) {
    (void)m_sender.send(m_port, datagram);
  }
}

Result<ThoughtsReceiver> ThoughtsReceiver::listen(int port) {
  if (const Result<void> valid = checkPort(port, 0); !valid)
    return tl::unexpected<Error>(valid.error());
  Descriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
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
    return failure(
        ErrorCode::SystemError,
        "port " + std::to_string(port) + " for thoughts cannot be had: " + systemReason(errno));
  }
  ThoughtsReceiver receiver(std::move(socket), ntohs(name.sin_port));
  receiver.m_buffer.resize(longestDatagram);
  return receiver;
}

void ThoughtsReceiver::poll(Time now) {
  for (int i = 0; i < mostPerPoll; ++i) {
    const ssize_t size = ::recv(m_socket.get(), m_buffer.data(), m_buffer.size(), 0);
    if (size < 0) break;
    RobotThoughts said;
    if (!readThoughtDatagram({m_buffer.data(), static_cast<std::size_t>(size)}, said)) {
      ++m_strange;
      continue;
    }
    Heard& heard = m_heard[said.robot];
    heard.thoughts.robot = said.robot;
    if (said.cloud) {
      heard.thoughts.cloud = std::move(said.cloud);
      heard.cloudTime = now;
    }
    if (said.path) {
      heard.thoughts.path = std::move(said.path);
      heard.pathTime = now;
    }
  }
}

std::vector<RobotThoughts> ThoughtsReceiver::thoughts(Time now) const {
  const auto age = [now](Time then) { return std::chrono::duration<double>(now - then).count(); };
  std::vector<RobotThoughts> all;
  for (const auto& [robot, heard] : m_heard) {
    RobotThoughts newest = heard.thoughts;
    newest.cloudAge = age(heard.cloudTime);
    newest.pathAge = age(heard.pathTime);
    if (now - heard.cloudTime > memory) newest.cloud.reset();
    if (now - heard.pathTime > memory) newest.path.reset();
    if (newest.cloud || newest.path) all.push_back(std::move(newest));
  }
  return all;
}

}  // namespace pitchboard::link
