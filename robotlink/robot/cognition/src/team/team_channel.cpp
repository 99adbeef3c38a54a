// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/cognition/team_channel.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <string>

#include <base/system_reason.h>
#include <base/try.h>
#include <base/unique_fd.h>
#include <robotlink/processes/lock_step_slots.h>
#include <telemetry/sockets/socket_address.h>
#include <telemetry/sockets/udp_sender.h>

namespace pitchboard::link {
namespace {

constexpr std::size_t maxWaiting = 64;
constexpr std::size_t maxMessageLength = 512;
constexpr int maxTeams = 100;

class UdpTeamChannel final : public TeamChannel {
 public:
  UdpTeamChannel(UniqueFd socket, telemetry::UdpSender sender, std::uint16_t port)
      : m_socket(std::move(socket)), m_sender(std::move(sender)), m_port(port) {}

  // A datagram starts with the sender's number, so that a robot does not hear itself.
  void post(RobotId from, std::string_view message) override {
    std::string datagram = std::to_string(from.value) + " ";
    datagram += message;
    if (datagram.size() > maxMessageLength) return;
    (void)m_sender.send(m_port, datagram);
  }

  std::vector<std::string> take(RobotId to) override {
    std::vector<std::string> messages;
    std::array<char, maxMessageLength> buffer;
    for (std::size_t i = 0; i < maxWaiting; ++i) {
      const ssize_t size = ::recv(m_socket.get(), buffer.data(), buffer.size(), MSG_DONTWAIT);
      if (size < 0) break;
      const char* const end = buffer.data() + size;
      int from = 0;
      const auto [rest, error] = std::from_chars(buffer.data(), end, from);
      if (error != std::errc{} || rest == end || *rest != ' ' || from == to.value) continue;
      messages.emplace_back(rest + 1, end);
    }
    return messages;
  }

 private:
  UniqueFd m_socket;
  telemetry::UdpSender m_sender;
  std::uint16_t m_port;
};

class LockStepChannel final : public TeamChannel {
 public:
  LockStepChannel(std::shared_ptr<LockStepSlot> slot, std::unique_ptr<TeamChannel> udp)
      : m_slot(std::move(slot)), m_udp(std::move(udp)) {}

  void post(RobotId from, std::string_view message) override {
    if (m_slot->inLockStep()) m_slot->post(message);
    m_udp->post(from, message);
  }
  std::vector<std::string> take(RobotId to) override {
    std::vector<std::string> received = m_udp->take(to);  // what lies there would be old news later
    return m_slot->inLockStep() ? m_slot->messages() : received;
  }

 private:
  std::shared_ptr<LockStepSlot> m_slot;
  std::unique_ptr<TeamChannel> m_udp;
};

Error systemError(const std::string& what) {
  return {ErrorCode::SystemError, what + ": " + systemReason(errno), "team messages"};
}

}  // namespace

void InProcessTeamChannel::post(RobotId from, std::string_view message) {
  for (Box& box : m_boxes) {
    if (box.owner == from) continue;
    if (box.messages.size() == maxWaiting) box.messages.pop_front();
    box.messages.emplace_back(message);
  }
}

std::vector<std::string> InProcessTeamChannel::take(RobotId to) {
  const auto found = std::ranges::find(m_boxes, to, &Box::owner);
  if (found == m_boxes.end()) {
    m_boxes.push_back({to, {}});
    return {};
  }
  std::vector<std::string> messages(found->messages.begin(), found->messages.end());
  found->messages.clear();
  return messages;
}

void InProcessTeamChannel::clear() {
  for (Box& box : m_boxes) box.messages.clear();
}

std::unique_ptr<TeamChannel> makeLockStepChannel(std::shared_ptr<LockStepSlot> slot,
                                                 std::unique_ptr<TeamChannel> udp) {
  return std::make_unique<LockStepChannel>(std::move(slot), std::move(udp));
}

Result<std::unique_ptr<TeamChannel>> makeUdpTeamChannel(const std::string& address, int team,
                                                        int portBase) {
  if (team < 0 || team >= maxTeams) {
    return failure(ErrorCode::InvalidArgument,
                   "the number of the team is " + std::to_string(team) + ", allowed are 0 to 99");
  }
  if (portBase < 1 || portBase + maxTeams > 65536) {
    return failure(ErrorCode::InvalidArgument,
                   "the port of the team would be " + std::to_string(portBase + team) +
                       "; choose a base from 1 to " + std::to_string(65536 - maxTeams));
  }
  const auto port = static_cast<std::uint16_t>(portBase + team);
  // A loopback datagram reaches one socket only, a broadcast on the loopback device all of them.
  const bool onlyHere = address == "127.0.0.1" || address == "127.255.255.255";
  const auto to = telemetry::parseAddress(onlyHere ? "127.255.255.255" : address);
  if (!to) {
    return failure(ErrorCode::InvalidArgument, "\"" + address +
                                                   "\" is not an IPv4 address; use for example "
                                                   "127.0.0.1 or 192.168.1.255");
  }
  auto sender = TRY(telemetry::UdpSender::to(*to));
  UniqueFd socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!socket) return tl::unexpected<Error>(systemError("Cannot open a UDP socket"));
  const int on = 1;
  // Several robots of one computer listen on the same port.
  ::setsockopt(socket.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  // Bound to the loopback broadcast address, it receives nothing from outside.
  const sockaddr_in here =
      telemetry::socketAddress(onlyHere ? *to : telemetry::Address{INADDR_ANY}, port);
  if (::bind(socket.get(), reinterpret_cast<const sockaddr*>(&here), sizeof here) != 0) {
    return tl::unexpected<Error>(
        systemError("Port " + std::to_string(port) + " cannot be listened to"));
  }
  return std::make_unique<UdpTeamChannel>(std::move(socket), std::move(sender), port);
}

}  // namespace pitchboard::link
