// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Shared memory through which a simulated match runs its separate reference processes cycle by
// cycle. The memory is anonymous (memfd): a process inherits it as file descriptor 3, and the
// kernel frees it with the last process. Each process has one slot. The match starts a cycle and
// passes the match time; the process runs the cycle and reports that it is done. In lock-step the
// match waits for that, otherwise it continues. No cycle is started while the match is paused or
// shows the past.
//
// In lock-step the messages of a team are passed through the slots as well, in the order of the
// robots, so that they arrive at the same tick in every run. Use each class from one thread.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <base/unique_fd.h>

namespace pitchboard::link {

struct SlotMemory;  // layout of the shared memory; private to the file

/// The mapping of the memory, with its file descriptor.
class SlotPages {
 public:
  SlotPages(SlotMemory* memory, UniqueFd descriptor)
      : m_memory(memory), m_fd(std::move(descriptor)) {}
  SlotPages(const SlotPages&) = delete;
  SlotPages& operator=(const SlotPages&) = delete;
  ~SlotPages();
  SlotMemory& memory() const { return *m_memory; }
  int descriptor() const { return m_fd.get(); }

 private:
  SlotMemory* m_memory;
  UniqueFd m_fd;
};

/// The side of the match.
class LockStepSlots {
 public:
  static Result<std::unique_ptr<LockStepSlots>> create();

  /// Reserves a cleared slot for a new process. Fails with Conflict if all slots are in use.
  Result<int> take();
  /// Frees the slot of a process that has ended.
  void release(int slot);
  /// Returns the file descriptor that the process inherits.
  int descriptor() const { return m_pages->descriptor(); }

  /// Returns the seconds between two cycles; empty until the process is ready.
  std::optional<double> period(int slot) const;
  /// Returns whether the last cycle is complete; true before the first one.
  bool isDone(int slot) const;
  /// Waits at most `longest` until the process is ready or done; returns whether it is.
  bool waitUntilReady(int slot, std::chrono::milliseconds longest) const;
  bool waitUntilDone(int slot, std::chrono::milliseconds longest) const;

  /// Starts a cycle at match time `seconds` of a process that is ready and done. `messages` are
  /// passed in lock-step only.
  void startCycle(int slot, double seconds, bool lockStep,
                  std::span<const std::string> messages = {});
  /// Returns the messages that the process sent to its team in its last lock-step cycle.
  std::vector<std::string> drainPosted(int slot);

 private:
  explicit LockStepSlots(std::unique_ptr<SlotPages> pages);
  std::unique_ptr<SlotPages> m_pages;
  std::vector<bool> m_taken;
};

/// What a process gets when a cycle starts.
struct CycleStart {
  double seconds = 0.0;  ///< match time
  bool lockStep = false;
};

/// The side of a process.
class LockStepSlot {
 public:
  /// The file descriptor as which a process inherits the memory.
  static constexpr int descriptor = 3;

  /// `slot` is the number that the match passed to the process on its command line.
  static Result<std::shared_ptr<LockStepSlot>> join(int slot);

  /// Reports that the process is ready for a cycle every `period` seconds of match time.
  void ready(double period);
  /// Waits for the start of the next cycle; empty if none started within `longest`.
  std::optional<CycleStart> wait(std::chrono::milliseconds longest);
  /// Reports that the cycle is complete.
  void done();
  /// Call these between wait() and done().
  bool inLockStep() const { return m_cycle.lockStep; }
  std::vector<std::string> messages() const;
  /// Sends a message: at most 16 of 512 bytes per cycle; more are dropped.
  void post(std::string_view message);

 private:
  LockStepSlot(std::unique_ptr<SlotPages> pages, int slot)
      : m_pages(std::move(pages)), m_index(slot) {}
  std::unique_ptr<SlotPages> m_pages;
  int m_index;
  std::uint32_t m_number = 0;  // of the last cycle
  CycleStart m_cycle;
};

}  // namespace pitchboard::link
