// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The memory over which a simulated match gives turns to its reference processes. Match and
// processes share anonymous memory (memfd), which a process inherits as descriptor 3 and which is
// freed with the last of them. Every process has a slot in it. The match gives a turn ("it is this
// time now, do one cycle"), and the process does its cycle and says so. In lock-step the match
// waits for that; running freely it does not. Without a turn nothing happens: while the match is
// paused or the past is shown, time stands still.
//
// In lock-step the messages of a team also travel here, in the order in which the match asks for
// them, so that they arrive at the same tick in every run. Use each class from one thread.

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

struct TurnMemory;  // layout of the shared memory; private to the file

/// The mapping of the memory, with its descriptor.
class TurnPages {
 public:
  TurnPages(TurnMemory* memory, UniqueFd descriptor)
      : m_memory(memory), m_fd(std::move(descriptor)) {}
  TurnPages(const TurnPages&) = delete;
  TurnPages& operator=(const TurnPages&) = delete;
  ~TurnPages();
  TurnMemory& memory() const { return *m_memory; }
  int descriptor() const { return m_fd.get(); }

 private:
  TurnMemory* m_memory;
  UniqueFd m_fd;
};

/// The side of the match.
class MatchTurns {
 public:
  static Result<std::unique_ptr<MatchTurns>> create();

  /// Takes a cleared slot for a new process. Fails with Conflict if there is none left.
  Result<int> takePlace();
  /// Frees the slot of a process that has ended.
  void giveBack(int place);
  /// Returns the descriptor that the process inherits.
  int descriptor() const { return m_pages->descriptor(); }

  /// Returns the seconds between two cycles; nothing until the process is ready.
  std::optional<double> period(int place) const;
  /// Returns whether the last turn is complete; true before the first one.
  bool isDone(int place) const;
  /// Waits at most `longest` until the process is ready or done; returns whether it is.
  bool waitUntilReady(int place, std::chrono::milliseconds longest) const;
  bool waitUntilDone(int place, std::chrono::milliseconds longest) const;

  /// Gives a turn to a process that is ready and done. `messages` matter in lock-step.
  void give(int place, double seconds, bool lockStep, std::span<const std::string> messages = {});
  /// Returns what it sent to its team in its last turn in lock-step.
  std::vector<std::string> takePosted(int place);

 private:
  explicit MatchTurns(std::unique_ptr<TurnPages> pages);
  std::unique_ptr<TurnPages> m_pages;
  std::vector<bool> m_taken;
};

/// A turn as the process receives it.
struct Turn {
  double seconds = 0.0;  ///< time of the match
  bool lockStep = false;
};

/// The side of a process.
class ProcessTurns {
 public:
  /// The descriptor as which a process inherits the memory.
  static constexpr int descriptor = 3;

  /// `place` is the slot that the match passed to the process.
  static Result<std::shared_ptr<ProcessTurns>> join(int place);

  /// Announces that it is ready for turns, one every so many seconds of the match.
  void ready(double period);
  /// Waits for the next turn; returns nothing after `longest`.
  std::optional<Turn> wait(std::chrono::milliseconds longest);
  /// Ends the turn.
  void done();
  /// Call these between wait() and done().
  bool inLockStep() const { return m_turn.lockStep; }
  std::vector<std::string> messages() const;
  /// Sends a message: at most 16 of 512 bytes per turn; more are dropped.
  void post(std::string_view message);

 private:
  ProcessTurns(std::unique_ptr<TurnPages> pages, int place)
      : m_pages(std::move(pages)), m_place(place) {}
  std::unique_ptr<TurnPages> m_pages;
  int m_place;
  std::uint32_t m_number = 0;  // of the turn that was taken last
  Turn m_turn;
};

}  // namespace pitchboard::link
