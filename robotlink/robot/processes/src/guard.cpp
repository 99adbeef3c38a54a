// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/processes/guard.h>

#include <sys/socket.h>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <map>
#include <thread>

#include <robotlink/blackboard/system_v.h>

namespace pitchboard::link {
namespace {

using namespace std::chrono_literals;

constexpr auto patience = 10s;

/// Removes segments that are no longer used. Returns whether one is still in use.
bool removeUnused(const std::map<int, int>& keysById) {
  bool used = false;
  for (const auto& [shmid, key] : keysById) {
    const auto info = SystemVSegments::info(key);
    if (!info || info->shmid != shmid) continue;
    if (info->attached == 0) {
      (void)SystemVSegments::remove(key);
    } else {
      used = true;
    }
  }
  return used;
}

}  // namespace

void runGuard(int input) {
  // The same Ctrl+C or end of a terminal that ends the others must find it at work.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_IGN);
  std::map<int, int> keysById;
  std::array<char, 64> packet{};
  while (::recv(input, packet.data(), packet.size() - 1, 0) > 0) {
    int key = 0, shmid = 0;
    if (packet.data() == std::string_view(guardMessages::done)) return;
    if (std::sscanf(packet.data(), "segment %d %d", &key, &shmid) == 2) keysById[shmid] = key;
    packet.fill('\0');
  }
  // The processes of the match end at the same time, and hold their segments until then.
  const auto end = std::chrono::steady_clock::now() + patience;
  while (removeUnused(keysById) && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(5ms);
  }
}

}  // namespace pitchboard::link
