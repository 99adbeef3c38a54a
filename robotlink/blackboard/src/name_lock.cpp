// SPDX-License-Identifier: GPL-3.0-or-later
#include "name_lock.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <utility>

#include <base/system_reason.h>

namespace pitchboard::link {
namespace {

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

Descriptor newSocket() {
  return Descriptor(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
}

// Who listens at the name: 0 when it is nobody (any more), −1 when it cannot be told.
pid_t holderOf(const Address& address) {
  const Descriptor client = newSocket();
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

}  // namespace

Result<NameLock> lockName(const std::string& name, const std::string& context) {
  const auto refused = [&context](const char* call) {
    return failure(ErrorCode::SystemError, std::string(call) + " failed: " + systemReason(errno),
                   context);
  };
  const Address address(name);
  // The holder may go away between bind and asking who it is; then the name is free.
  for (int attempt = 0; attempt < 8; ++attempt) {
    Descriptor server = newSocket();
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

}  // namespace pitchboard::link
