// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The runner's thread: what it shares with the callers, and its loop. Private to robotlink.

#include <condition_variable>
#include <deque>
#include <mutex>
#include <stop_token>

#include <robotlink/match/match_runner.h>
#include <robotlink/match/pacer.h>

#include "frame_builder.h"

namespace pitchboard::link {

/// Frames that nobody looks at any more are filled again, so that playing allocates next to
/// nothing.
class FramePool : public std::enable_shared_from_this<FramePool> {
 public:
  std::shared_ptr<MatchFrame> take();

 private:
  static constexpr std::size_t mostKept = 8;
  void giveBack(std::unique_ptr<MatchFrame> frame);
  std::mutex m_mutex;
  std::vector<std::unique_ptr<MatchFrame>> m_free;
};

class MatchLoop;

struct MatchRunner::Shared {
  static constexpr std::size_t mostQueued = 10'000;

  mutable std::mutex mutex;                      // guards everything below
  mutable std::condition_variable_any changed;   // for the thread
  mutable std::condition_variable_any stillNow;  // for waitUntilStill()
  std::deque<Command> commands;
  bool paused = false;
  int singleSteps = 0;
  bool paceChanged = true;
  bool settled = false;  // stands still, and the latest frame shows it
  double speed = 1.0;
  std::optional<std::uint64_t> runTo;
  std::shared_ptr<const MatchFrame> latest;
  std::deque<MatchEvent> events;
  std::deque<LogLine> log;
  std::uint64_t droppedEvents = 0;
  std::uint64_t droppedLogLines = 0;

  MatchLoop* loop = nullptr;  // for commands, which run on its thread
};

class MatchLoop {
 public:
  MatchLoop(MatchRunner::Shared& shared, SimulatedMatch match);
  /// Until stopped.
  void run(const std::stop_token& stop);
  void publish();
  /// Shows it the present moment.
  void observe(std::shared_ptr<TickObserver> observer);
  void stopObserving(const std::shared_ptr<TickObserver>& observer);

 private:
  using Clock = std::chrono::steady_clock;

  bool carryOutCommands();
  /// Plays what is due; says when to look again.
  Clock::time_point play(Clock::time_point now);
  void tickOnce();
  std::uint64_t playBatch(Clock::time_point until, std::uint64_t lastTick);
  void showObservers(std::chrono::nanoseconds tickTime);
  /// Shows observers what has happened, and keeps it for collectEvents().
  void tellEvents();
  void collectEvents();
  void pollChildren();
  void log(const std::string& origin, const std::string& text, bool warning);
  std::string nameOf(const ChildSpec& child) const;
  bool refreshesWhileStill() const;

  MatchRunner::Shared& m_shared;
  SimulatedMatch m_match;
  Pacer m_pacer;
  FrameBuilder m_builder;
  std::shared_ptr<FramePool> m_pool = std::make_shared<FramePool>();
  std::vector<std::shared_ptr<TickObserver>> m_observers;
  std::vector<MatchEvent> m_newEvents;
  Clock::time_point m_lastPublish;
  Clock::time_point m_lastPoll;
  std::uint64_t m_serial = 0;
  bool m_still = false;
  bool m_publishWanted = false;
};

}  // namespace pitchboard::link
