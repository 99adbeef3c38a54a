// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Ends a command cleanly after Ctrl+C, SIGTERM or SIGHUP. Main thread.

#include <atomic>
#include <csignal>

namespace pitchboard::cli {

/// Becomes true when a signal arrives while an InterruptGuard exists.
inline std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

/// Handles SIGINT, SIGTERM and SIGHUP, and restores the previous handlers when it is destroyed.
class InterruptGuard {
 public:
  InterruptGuard() {
    interrupted = false;
    struct sigaction action {};
    action.sa_handler = [](int) { interrupted = true; };
    sigaction(SIGINT, &action, &m_int);
    sigaction(SIGTERM, &action, &m_term);
    sigaction(SIGHUP, &action, &m_hup);
  }
  ~InterruptGuard() {
    sigaction(SIGINT, &m_int, nullptr);
    sigaction(SIGTERM, &m_term, nullptr);
    sigaction(SIGHUP, &m_hup, nullptr);
  }
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  struct sigaction m_int {
  }, m_term{}, m_hup{};
};

}  // namespace pitchboard::cli
