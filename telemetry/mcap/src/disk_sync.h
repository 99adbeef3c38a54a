// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Waits for the disk in a thread of its own, so that a file goes on growing while the disk is slow:
// what the kernel has been given outlives the process, and only a power cut needs the disk to have
// it. Any thread.

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include <base/result.h>

namespace pitchboard::telemetry {

class DiskSync {
 public:
  /// `sync` is called in the thread, one call at a time; it returns when the disk has what was
  /// written before the call. It must be callable as long as this object lives.
  explicit DiskSync(std::function<Result<void>()> sync);
  ~DiskSync();  ///< waits for the call in progress only
  DiskSync(const DiskSync&) = delete;
  DiskSync& operator=(const DiskSync&) = delete;

  /// Returns at once. The error is that of an earlier request; it stays.
  Result<void> request();
  /// A last request, and waits until the disk has everything.
  Result<void> finish();
  /// How long the disk has been owing an answer, s; 0: it has everything.
  double syncLatency() const;

 private:
  using Clock = std::chrono::steady_clock;
  void run();

  const std::function<Result<void>()> m_sync;
  mutable std::mutex m_mutex;  // of everything below
  std::condition_variable m_wake, m_settled;
  std::optional<Clock::time_point> m_asked;    // the oldest request that waits
  std::optional<Clock::time_point> m_running;  // when the one in progress was asked for
  std::optional<Error> m_error;
  bool m_stop = false;
  std::thread m_thread;  // last: it uses all of the above
};

}  // namespace pitchboard::telemetry
