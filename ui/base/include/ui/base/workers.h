// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Worker threads for the UI thread. With one thread, work runs in the order of start(). Owned by
// whoever starts the work; the destructor waits for all of it. Used instead of QThreadPool, because
// a thread sanitizer cannot see into the latter. Any thread may call it.

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
  /// Starts the work only if a thread is idle; returns whether it did.
  bool tryStart(Work work);
  /// Waits until all work is done.
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

/// Returns workers with a thread for each core, shared by everybody who splits work.
Workers& sharedWorkers();

}  // namespace pitchboard::ui
