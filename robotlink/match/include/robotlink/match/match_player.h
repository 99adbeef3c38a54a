// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plays a SimulatedMatch: the one loop of ticks, for the runner's thread, for programs that play a
// match in their own, and for recording. Keeps the pace, measures the ticks and shows them to the
// observers. For the thread that made the match; owns the match.

#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <robotlink/match/pacer.h>
#include <robotlink/match/tick_observer.h>

namespace pitchboard::link {

class MatchPlayer {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr double unlimitedSpeed = 0.0;
  static constexpr std::uint64_t noLastTick = std::numeric_limits<std::uint64_t>::max();

  /// Plays as fast as possible until setSpeed().
  explicit MatchPlayer(SimulatedMatch match) : m_match(std::move(match)) {}

  SimulatedMatch& match() { return m_match; }
  const SimulatedMatch& match() const { return m_match; }
  std::uint64_t currentTick() const { return m_match.simulation().state().tick; }

  /// Shows it the present moment and every tick from now on. They are called in this order.
  void observe(std::shared_ptr<TickObserver> observer);
  void stopObserving(const std::shared_ptr<TickObserver>& observer);
  std::span<const std::shared_ptr<TickObserver>> observers() const { return m_observers; }

  /// 1 = real time, from `now` on; slower while a team's own programs cannot keep up
  /// (MatchOptions::waitForTeamPrograms).
  void setSpeed(double timesRealTime, Clock::time_point now);

  struct Played {
    std::uint64_t ticks = 0;
    Clock::duration busy{};
    Clock::time_point next{};  ///< when to play on; in the past: at once
  };
  /// Plays what is due at `now`, for some milliseconds at most and not past `lastTick`. First it
  /// waits until a team's programs are there: see awaitPrograms().
  Played play(Clock::time_point now, std::uint64_t lastTick = noLastTick);
  /// A team's program is not there yet (ProcessPace::awaitsPrograms()): do not go on, ask again
  /// soon. The first time it plays a tick, so that there is something to be seen.
  bool awaitPrograms(Clock::time_point now);
  /// One tick, whatever the pace.
  void tick();
  /// Looks after the robots' processes, and tells the observers what they wrote and what happened
  /// to them. About 20 times a second; while the match stands still four times, and when
  /// ProcessManager::descriptor() is readable.
  void lookAfterProcesses(Clock::time_point now);
  /// Tells the observers what has happened between ticks: processes that ended, orders by hand,
  /// and what was drawn.
  void tellEvents();
  /// Shows the observers a moment without a tick.
  void showMoment();
  /// Tells them that the next tick does not go on from what they have seen.
  void worldChanged();

 private:
  bool await(ProcessPace::Await whom, Clock::time_point now);
  void setPace(double timesRealTime, Clock::time_point now);
  void followPrograms(Clock::time_point now);
  void tellLines(Clock::time_point now);

  SimulatedMatch m_match;
  Pacer m_pacer;
  double m_wanted = unlimitedSpeed, m_speed = unlimitedSpeed;
  Clock::time_point m_followed{};
  bool m_awaits = false;
  std::vector<std::shared_ptr<TickObserver>> m_observers;
  std::vector<MatchEvent> m_events;  // scratch of tellEvents()
  std::vector<ReceivedDrawing> m_drawings;
};

}  // namespace pitchboard::link
