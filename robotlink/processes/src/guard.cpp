// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/processes/guard.h>

#include <unistd.h>
#include <array>
#include <cerrno>
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

class Guard {
 public:
  /// False once there is nothing to do any more.
  bool read(int input) {
    std::array<char, 4096> buffer;
    const ssize_t got = ::read(input, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) return true;
    if (got <= 0) return false;
    m_text.append(buffer.data(), static_cast<std::size_t>(got));
    for (std::size_t end = m_text.find('\n'); end != std::string::npos; end = m_text.find('\n')) {
      take(m_text.substr(0, end + 1));
      m_text.erase(0, end + 1);
    }
    return !m_done;
  }

  /// The processes of the match end at the same time, and hold their segments until then.
  void tidyUp() const {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (!m_done && removeUnused() && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(5ms);
    }
  }

 private:
  /// Removes what nobody uses any more; whether one of the segments is still used.
  bool removeUnused() const {
    bool used = false;
    for (const auto& [shmid, key] : m_segments) {
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

  void take(const std::string& line) {
    int key = 0, shmid = 0;
    if (line == guardWords::done) {
      m_done = true;
    } else if (std::sscanf(line.c_str(), "segment %d %d", &key, &shmid) == 2) {
      m_segments[shmid] = key;
    }
  }

  std::string m_text;
  std::map<int, int> m_segments;  // keys by shmid
  bool m_done = false;
};

}  // namespace

void runGuard(int input) {
  // The same Ctrl+C or end of a terminal that ends the others must find it at work.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_IGN);
  Guard guard;
  while (guard.read(input)) {
  }
  guard.tidyUp();
}

}  // namespace pitchboard::link
