// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The runner's thread: what it shares with the callers, and its loop. Private to robotlink.

#include <condition_variable>
#include <deque>
#include <mutex>
#include <stop_token>

#include <robotlink/match/match_player.h>
#include <robotlink/match/match_runner.h>

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

/// What happened since it was asked last.
class NewEvents : public TickObserver {
 public:
  void ticked(const SimulatedMatch& /*match*/, std::chrono::nanoseconds /*tickTime*/) override {}
  void happened(std::span<const MatchEvent> events) override {
    list.insert(list.end(), events.begin(), events.end());
  }
  std::vector<MatchEvent> list;
};

class MatchLoop {
 public:
  MatchLoop(MatchRunner::Shared& shared, SimulatedMatch match);
  /// Until stopped.
  void run(const std::stop_token& stop);
  void publish();
  MatchPlayer& player() { return m_player; }

 private:
  using Clock = std::chrono::steady_clock;

  bool carryOutCommands();
  /// Plays what is due; says when to look again.
  Clock::time_point play(Clock::time_point now);
  Clock::time_point playBatch(Clock::time_point now, std::uint64_t lastTick);
  void collectEvents();
  void pollProcesses();
  void log(const std::string& origin, const std::string& text, LogLevel level);
  std::string nameOf(const ProcessLine& line) const;
  bool refreshesWhileStill() const;
  /// Slower while a team's own programs cannot keep up, if that is wanted, and faster again.
  void followOwnPrograms(Clock::time_point now);

  MatchRunner::Shared& m_shared;
  MatchPlayer m_player;
  SimulatedMatch& m_match;  // the player's
  FrameBuilder m_builder;
  std::shared_ptr<FramePool> m_pool = std::make_shared<FramePool>();
  const std::shared_ptr<NewEvents> m_newEvents = std::make_shared<NewEvents>();
  Clock::time_point m_lastPublish;
  Clock::time_point m_lastPoll;
  std::uint64_t m_serial = 0;
  double m_wantedSpeed = 1.0, m_speed = 1.0;
  Clock::time_point m_lastFollow;
  bool m_still = false;
  bool m_publishWanted = false;
};

}  // namespace pitchboard::link
