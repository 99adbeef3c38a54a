// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plays a SimulatedMatch on a thread of its own at a chosen pace. Commands go in (carried out
// between two ticks, in order), values come out (the latest frame wins; events and log lines are
// queued, bounded and counted). All public functions may be called from any thread.

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include <robotlink/frame/match_event.h>
#include <robotlink/frame/match_frame.h>
#include <robotlink/match/match_player.h>
#include <robotlink/match/simulated_match.h>
#include <robotlink/match/tick_observer.h>

namespace pitchboard::link {

/// Whether a command changed the world (not only blackboards and processes): then the next tick
/// does not go on from what observers have seen.
enum class Changed { No, Yes };

class MatchRunner {
 public:
  static constexpr double unlimitedSpeed = MatchPlayer::unlimitedSpeed;

  /// Makes the match on the runner's thread (its processes must belong to that thread) and starts
  /// paused or playing. Fails with the reason when the match cannot be made. `observers` see the
  /// match from its first moment.
  static Result<std::unique_ptr<MatchRunner>> start(
      const Scenario& scenario, const MatchOptions& options, bool paused = false,
      const VariableCatalog& catalog = VariableCatalog::published(),
      std::vector<std::shared_ptr<TickObserver>> observers = {});
  ~MatchRunner();  ///< stops, ends processes, joins

  void setPaused(bool paused);
  /// One tick, then pause.
  void stepOnce();
  /// 1 = real time; unlimitedSpeed = as fast as possible.
  void setSpeed(double timesRealTime);
  /// Plays at full speed up to this tick, then pauses; for tests and repeatable pictures.
  void runTo(std::uint64_t tick);
  /// Waits until the match stands still (paused, or over); false when it still plays after that.
  bool waitUntilStill(std::chrono::milliseconds timeout) const;

  /// Carried out on the runner's thread between two ticks, also while paused.
  using Command = std::function<Changed(SimulatedMatch&)>;
  void post(Command command);
  /// The same, and waits for it. Not from within a command.
  void execute(const Command& command);
  /// Waits for it as well; it changes nothing.
  void read(const std::function<void(const SimulatedMatch&)>& look);

  /// Shows it the present moment and every tick from now on, until stopObserving(). Waits for the
  /// tick in progress; so does stopObserving(). Neither from within a command.
  void observe(const std::shared_ptr<TickObserver>& observer);
  void stopObserving(const std::shared_ptr<TickObserver>& observer);

  /// `tell` is called on the runner's thread when there is a frame, an event or a line that was not
  /// there yet, once until latest(), takeEvents() or takeLog() is asked. Empty: nobody is told, but
  /// a call may be under way.
  void setNews(std::function<void()> tell);
  /// The newest frame, or nothing when `knownSerial` is already the newest.
  std::shared_ptr<const MatchFrame> latest(std::uint64_t knownSerial = 0);
  /// Both give what came since the last call, at most the newest 10 000.
  std::vector<MatchEvent> takeEvents();
  std::vector<LogLine> takeLog();

  struct Shared;  ///< between the thread and the callers; private to the library

 private:
  explicit MatchRunner(std::shared_ptr<Shared> shared);
  std::shared_ptr<Shared> m_shared;
  std::jthread m_thread;
};

}  // namespace pitchboard::link
