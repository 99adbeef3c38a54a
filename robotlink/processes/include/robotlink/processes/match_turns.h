// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How the reference processes of a simulated match take their time from it. Match and processes
// share one piece of nameless memory (memfd), which the process inherits as descriptor 3 and which
// is gone with the last of them; processes that know nothing of it do not see it. Every process has
// a place in it. The match gives a turn: "it is this time now, do one cycle"; the process does it
// and says so. In lock-step the match waits for that, running freely it does not. Nobody thinks
// without a turn: while the match is paused, stepped or looked back at, time stands still.
//
// In lock-step the messages of a team travel here, too, in the order in which the match asks for
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

struct TurnMemory;  // the shared memory; private to the file

/// The mapping of the memory, and the descriptor behind it.
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

/// The match's side.
class MatchTurns {
 public:
  static Result<std::unique_ptr<MatchTurns>> create();

  /// For a process to be started; cleared. Conflict when there is none left.
  Result<int> takePlace();
  /// Its process has ended.
  void giveBack(int place);
  /// To be inherited by the process.
  int descriptor() const { return m_pages->descriptor(); }

  /// Seconds between two cycles; nothing until the process is ready.
  std::optional<double> period(int place) const;
  /// The last turn given was taken to its end (also before the first).
  bool isDone(int place) const;
  /// Waits until it is ready or done, `longest` at most; says whether it is.
  bool waitUntilReady(int place, std::chrono::milliseconds longest) const;
  bool waitUntilDone(int place, std::chrono::milliseconds longest) const;

  /// Only to a process that is ready and done. `messages` matter in lock-step.
  void give(int place, double seconds, bool lockStep, std::span<const std::string> messages = {});
  /// What it posted to its team in its last turn in lock-step.
  std::vector<std::string> takePosted(int place);

 private:
  explicit MatchTurns(std::unique_ptr<TurnPages> pages);
  std::unique_ptr<TurnPages> m_pages;
  std::vector<bool> m_taken;
};

/// A turn as the process gets it.
struct Turn {
  double seconds = 0.0;  ///< of the match
  bool lockStep = false;
};

/// The process's side.
class ProcessTurns {
 public:
  /// What a process inherits the memory as.
  static constexpr int descriptor = 3;

  /// `place` as its starter told.
  static Result<std::shared_ptr<ProcessTurns>> join(int place);

  /// Ready for turns, one every so many seconds of the match.
  void ready(double period);
  /// The next turn, or nothing after `longest`.
  std::optional<Turn> wait(std::chrono::milliseconds longest);
  /// The turn is over.
  void done();
  /// Between wait() and done().
  bool inLockStep() const { return m_turn.lockStep; }
  std::vector<std::string> messages() const;
  /// At most 16 messages of 512 bytes a turn; more are dropped.
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
