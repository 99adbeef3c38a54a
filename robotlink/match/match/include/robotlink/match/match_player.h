// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The loop of ticks of a SimulatedMatch, for the runner's thread, for programs that play on their
// own thread, and for recording. It keeps the pace, measures ticks and calls observers. It owns the
// match and must be used by the thread that created the match.

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

  /// Until setSpeed() is called, it plays as fast as possible.
  explicit MatchPlayer(SimulatedMatch match) : m_match(std::move(match)) {}

  SimulatedMatch& match() { return m_match; }
  const SimulatedMatch& match() const { return m_match; }
  std::uint64_t currentTick() const { return m_match.simulation().state().tick; }

  /// Adds an observer, which sees the present moment and every later tick, in order of addition.
  void observe(std::shared_ptr<TickObserver> observer);
  void stopObserving(const std::shared_ptr<TickObserver>& observer);
  std::span<const std::shared_ptr<TickObserver>> observers() const { return m_observers; }

  /// Sets the speed from `now` on; 1 is real time. It is slower while team programs cannot keep up
  /// (MatchOptions::waitForTeamPrograms).
  void setSpeed(double timesRealTime, Clock::time_point now);

  struct Played {
    std::uint64_t ticks = 0;
    Clock::duration busy{};
    Clock::time_point next{};  ///< when to call again; in the past: at once
  };
  /// Plays the ticks that are due at `now`, for some milliseconds at most and not beyond
  /// `lastTick`. At the beginning it waits for team programs: see awaitPrograms().
  Played play(Clock::time_point now, std::uint64_t lastTick = noLastTick);
  /// Returns true while a team program has not attached yet (ProcessPace::awaitsPrograms()): call
  /// again soon. The first call plays a tick, so that there is something to see.
  bool awaitPrograms(Clock::time_point now);
  /// Plays one tick now.
  void tick();
  /// Watches the robots' processes, and tells observers what they printed and what happened to
  /// them. Call it about 20 times a second; while the match is paused four times, and when
  /// ProcessManager::descriptor() is readable.
  void lookAfterProcesses(Clock::time_point now);
  /// Tells observers what happened between ticks: ended processes, edits by hand, and drawings.
  /// Call it after such changes.
  void reportEvents();
  /// Shows observers the present moment without a tick.
  void showMoment();
  /// Tells observers that the next tick does not follow from what they have seen.
  void worldChanged();

 private:
  bool await(ProcessPace::Await whom, Clock::time_point now);
  void setPace(double timesRealTime, Clock::time_point now);
  void followPrograms(Clock::time_point now);
  void reportLines(Clock::time_point now);

  SimulatedMatch m_match;
  Pacer m_pacer;
  double m_wanted = unlimitedSpeed, m_speed = unlimitedSpeed;
  Clock::time_point m_followed{};
  bool m_awaits = false;
  std::vector<std::shared_ptr<TickObserver>> m_observers;
  std::vector<MatchEvent> m_events;  // scratch of reportEvents()
  std::vector<ReceivedDrawing> m_drawings;
};

}  // namespace pitchboard::link
