// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/cognition/team_channel.h>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <string>

#include <base/system_reason.h>

namespace pitchboard::link {
namespace {

constexpr std::size_t mostWaiting = 64;
constexpr std::size_t longestMessage = 512;
constexpr int firstPort = 10000;
constexpr int mostTeams = 100;

/// A socket that closes itself.
class Socket {
 public:
  explicit Socket(int fd) : m_fd(fd) {}
  Socket(Socket&& other) noexcept : m_fd(std::exchange(other.m_fd, -1)) {}
  Socket& operator=(Socket&&) = delete;
  ~Socket() {
    if (m_fd >= 0) ::close(m_fd);
  }
  int fd() const { return m_fd; }

 private:
  int m_fd;
};

class UdpTeamChannel final : public TeamChannel {
 public:
  UdpTeamChannel(Socket socket, const sockaddr_in& to) : m_socket(std::move(socket)), m_to(to) {}

  // A datagram starts with the sender's number, so that a robot does not hear itself.
  void post(RobotId from, std::string_view message) override {
    std::string datagram = std::to_string(from.value) + " ";
    datagram += message;
    if (datagram.size() > longestMessage) return;
    (void)::sendto(m_socket.fd(), datagram.data(), datagram.size(), MSG_DONTWAIT,
                   reinterpret_cast<const sockaddr*>(&m_to), sizeof m_to);
  }

  std::vector<std::string> take(RobotId to) override {
    std::vector<std::string> messages;
    std::array<char, longestMessage> buffer;
    for (std::size_t i = 0; i < mostWaiting; ++i) {
      const ssize_t size = ::recv(m_socket.fd(), buffer.data(), buffer.size(), MSG_DONTWAIT);
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
  Socket m_socket;
  sockaddr_in m_to;
};

Error systemError(const std::string& what) {
  return {ErrorCode::SystemError, what + ": " + systemReason(errno), "team messages"};
}

}  // namespace

void InProcessTeamChannel::post(RobotId from, std::string_view message) {
  for (Box& box : m_boxes) {
    if (box.owner == from) continue;
    if (box.messages.size() == mostWaiting) box.messages.pop_front();
    box.messages.emplace_back(message);
  }
}

std::vector<std::string> InProcessTeamChannel::take(RobotId to) {
  const auto found =
      std::find_if(m_boxes.begin(), m_boxes.end(), [to](const Box& b) { return b.owner == to; });
  if (found == m_boxes.end()) {
    m_boxes.push_back({to, {}});
    return {};
  }
  std::vector<std::string> messages(found->messages.begin(), found->messages.end());
  found->messages.clear();
  return messages;
}

Result<std::unique_ptr<TeamChannel>> makeUdpTeamChannel(const std::string& address, int team) {
  if (team < 0 || team >= mostTeams) {
    return failure(ErrorCode::InvalidArgument,
                   "the number of the team is " + std::to_string(team) + ", allowed are 0 to 99");
  }
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(firstPort + team));
  // A loopback datagram reaches one socket only, a broadcast on the loopback device all of them.
  const std::string target = address == "127.0.0.1" ? "127.255.255.255" : address;
  if (::inet_pton(AF_INET, target.c_str(), &to.sin_addr) != 1) {
    return failure(ErrorCode::InvalidArgument, "\"" + address +
                                                   "\" is not an IPv4 address; use for example "
                                                   "127.0.0.1 or 192.168.1.255");
  }
  Socket socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (socket.fd() < 0) return tl::unexpected<Error>(systemError("The system gives no UDP socket"));
  const int on = 1;
  // Several robots of one computer listen on the same port.
  ::setsockopt(socket.fd(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  ::setsockopt(socket.fd(), SOL_SOCKET, SO_BROADCAST, &on, sizeof on);
  sockaddr_in here = to;
  // Bound to the loopback broadcast address, nothing from outside is heard.
  if (target != "127.255.255.255") here.sin_addr.s_addr = htonl(INADDR_ANY);
  if (::bind(socket.fd(), reinterpret_cast<const sockaddr*>(&here), sizeof here) != 0) {
    return tl::unexpected<Error>(
        systemError("Port " + std::to_string(firstPort + team) + " cannot be listened to"));
  }
  return std::make_unique<UdpTeamChannel>(std::move(socket), to);
}

}  // namespace pitchboard::link
