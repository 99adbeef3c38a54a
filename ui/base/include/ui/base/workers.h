// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Threads that do work for the UI thread: with one thread, in the order of start(). Owned by
// whoever starts work there; the destructor waits for all of it. They take the place of
// QThreadPool, whose hand-overs a thread sanitizer cannot see. Any thread may call them.

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace pitchboard::ui {

class Workers {
 public:
  using Work = std::function<void()>;

  explicit Workers(std::size_t threads = 1);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  void start(Work work);
  /// Only when a thread has nothing to do; whether it was started.
  bool tryStart(Work work);
  /// Until nothing waits and nothing is done any more.
  void waitForDone();
  std::size_t threads() const { return m_most; }

 private:
  void add(Work work);
  void run();

  const std::size_t m_most;
  std::mutex m_mutex;
  std::condition_variable m_wake, m_done;
  // Guarded by m_mutex:
  std::deque<Work> m_waiting;
  std::size_t m_busy = 0;
  bool m_ending = false;
  std::vector<std::thread> m_threads;  // made when they are first needed
};

/// As many threads as the machine has cores, for work that anyone may split.
Workers& sharedWorkers();

}  // namespace pitchboard::ui
