// SPDX-License-Identifier: GPL-3.0-or-later
// What only one program of this computer may have: the simulated side of a robot, a match number.
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <utility>

#include <base/system_reason.h>
#include <base/try.h>
#include <base/unique_fd.h>
#include <robotlink/blackboard/match_number.h>
#include <robotlink/blackboard/system_v.h>

namespace pitchboard::link {
namespace {

/// The name of an abstract Unix socket as a lock that cannot outlive its owner: the kernel frees it
/// whatever happens. Names are shared by all users of the machine, so the user is part of them.
struct NameLock {
  UniqueFd socket;     ///< holds the name while it is open; empty: somebody else holds it
  std::string holder;  ///< "pitchboard, process 123", "this program"; empty: it is just changing
};

struct Address {
  sockaddr_un value{};
  socklen_t length = 0;

  explicit Address(const std::string& name) {
    value.sun_family = AF_UNIX;
    // The leading zero byte makes the name abstract.
    const int written = std::snprintf(value.sun_path + 1, sizeof value.sun_path - 1,
                                      "pitchboard-%u-%s", geteuid(), name.c_str());
    length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 +
                                    static_cast<std::size_t>(written));
  }
  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&value); }
};

UniqueFd newSocket() {
  return UniqueFd(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
}

// Returns the process that holds the claim: 0 if nobody does, −1 if it is unknown.
pid_t holderOf(const Address& address) {
  const UniqueFd client = newSocket();
  if (!client) return -1;
  pid_t holder = -1;
  if (connect(client.get(), address.get(), address.length) == 0) {
    ucred peer{};
    socklen_t size = sizeof peer;
    if (getsockopt(client.get(), SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 && peer.pid > 0)
      holder = peer.pid;
  } else if (errno == ECONNREFUSED) {
    holder = 0;
  }
  return holder;
}

std::string describeHolder(pid_t holder) {
  if (holder == getpid()) return "this program";
  if (holder < 0) return "another program";
  std::string name;
  std::ifstream("/proc/" + std::to_string(holder) + "/comm") >> name;
  return (name.empty() ? "process " : name + ", process ") + std::to_string(holder);
}

/// Takes "pitchboard-`name`" of this user. An error is a refusal of the system.
Result<NameLock> lockName(const std::string& name, const std::string& context) {
  const auto refused = [&context](const char* call) {
    return failure(ErrorCode::SystemError, std::string(call) + " failed: " + systemReason(errno),
                   context);
  };
  const Address address(name);
  // The holder may go away between bind and asking who it is; then the name is free.
  for (int attempt = 0; attempt < 8; ++attempt) {
    UniqueFd server = newSocket();
    if (!server) return refused("socket");
    if (bind(server.get(), address.get(), address.length) == 0) {
      // Listening is what lets the refused one learn who holds the claim.
      if (listen(server.get(), 4) != 0) return refused("listen");
      return NameLock{std::move(server), {}};
    }
    if (errno != EADDRINUSE) return refused("bind");
    const pid_t holder = holderOf(address);
    if (holder != 0) return NameLock{{}, describeHolder(holder)};
  }
  return NameLock{};
}

}  // namespace

Result<BridgeClaim> BridgeClaim::take(int key) {
  const std::string context = "blackboard " + std::to_string(key);
  auto lock = TRY(lockName("bridge-" + std::to_string(key), context));
  if (lock.socket) return BridgeClaim(std::move(lock.socket));
  return failure(ErrorCode::Conflict,
                 lock.holder.empty()
                     ? "another program is claiming or releasing this robot; try again"
                     : "is already being simulated by " + lock.holder +
                           "; end that one, or choose another robot number or match number",
                 context);
}

Result<MatchClaim> MatchClaim::take(int number) {
  const std::string context = "match " + std::to_string(number);
  if (number < 0 || number > MatchNumber::most) {
    return failure(ErrorCode::InvalidArgument,
                   "match numbers are 0 to " + std::to_string(MatchNumber::most), context);
  }
  auto lock = TRY(lockName("match-" + std::to_string(number), context));
  if (lock.socket) return MatchClaim(MatchNumber{number}, std::move(lock.socket), {});
  return failure(ErrorCode::Conflict,
                 "is already in use" +
                     (lock.holder.empty() ? std::string() : " by " + lock.holder) +
                     "; leave the number out to get the next free one",
                 context);
}

Result<MatchClaim> MatchClaim::takeFree(const std::function<bool(MatchNumber)>& suits) {
  std::string holder;
  for (int number = 0; number <= MatchNumber::most; ++number) {
    if (suits && !suits(MatchNumber{number})) continue;
    auto lock = TRY(lockName("match-" + std::to_string(number), "match " + std::to_string(number)));
    if (lock.socket) return MatchClaim(MatchNumber{number}, std::move(lock.socket), holder);
    if (number == 0) holder = lock.holder.empty() ? "another program" : lock.holder;
  }
  return failure(ErrorCode::Conflict, "all " + std::to_string(MatchNumber::most + 1) +
                                          " match numbers of this computer are in use; end a match "
                                          "whose processes run separately");
}

}  // namespace pitchboard::link
