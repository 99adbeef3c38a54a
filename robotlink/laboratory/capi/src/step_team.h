// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Threads that share work on numbered pieces: run() gives every piece to one of them, the caller's
// included, and returns when all are done. Which thread takes which pieces is nobody's business, so
// the results of pieces must not depend on each other. Owned and used by one thread.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include <base/result.h>

namespace pitchboard::link {

class StepTeam {
 public:
  /// Does the pieces from `first` up to `last`. `worker`: which thread does, from 0.
  using Work = std::function<void(std::size_t worker, std::size_t first, std::size_t last)>;

  StepTeam() = default;
  ~StepTeam();
  StepTeam(const StepTeam&) = delete;
  StepTeam& operator=(const StepTeam&) = delete;

  /// `threads` in all, the caller's included. Fails when the system gives no more; once only.
  Result<void> start(int threads);
  /// How many threads work, the caller's included.
  std::size_t workers() const { return m_threads.size() + 1; }
  /// `units`: how much there is to do in each piece, such as ticks. What takes less time than
  /// waking the others, judged by what a unit took last time, the caller does alone.
  void run(std::size_t pieces, std::size_t units, const Work& work);

  using Seconds = std::chrono::duration<double>;
  /// Returns whether the work is worth waking the other threads. Unknown work (0 s) is.
  static bool isWorthSharing(std::size_t pieces, std::size_t units, Seconds perUnit);

 private:
  void serve(std::size_t worker);
  /// Returns how many it took.
  std::size_t takePieces(std::size_t worker);

  std::mutex m_mutex;
  std::condition_variable m_begun, m_done;
  const Work* m_work = nullptr;
  std::size_t m_pieces = 0, m_atOnce = 1;
  std::atomic<std::size_t> m_next = 0;
  std::size_t m_round = 0;
  std::size_t m_busy = 0;
  Seconds m_perUnit{};  // of the caller's own pieces in the last run; 0: not known yet
  bool m_ends = false;
  std::vector<std::thread> m_threads;
};

}  // namespace pitchboard::link
