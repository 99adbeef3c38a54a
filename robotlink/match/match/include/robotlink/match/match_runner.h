// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plays a SimulatedMatch on a thread of its own, at a chosen speed. Commands run between two ticks,
// in order. Results are values: only the newest frame is kept; events and log lines are queued up
// to a limit, and what exceeds it is counted. All public functions may be called from any thread.

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

/// Whether a command changed the world, not only blackboards and processes. If so, the next tick
/// does not follow from what observers have seen.
enum class Changed { No, Yes };

class MatchRunner {
 public:
  static constexpr double unlimitedSpeed = MatchPlayer::unlimitedSpeed;

  /// Creates the match on the runner's thread, to which its processes belong, and starts it paused
  /// or playing. Fails with the reason if the match cannot be created. `observers` see the match
  /// from its first moment.
  static Result<std::unique_ptr<MatchRunner>> start(
      const Scenario& scenario, const MatchOptions& options, bool paused = false,
      const VariableCatalog& catalog = VariableCatalog::published(),
      std::vector<std::shared_ptr<TickObserver>> observers = {});
  ~MatchRunner();  ///< stops the match, ends its processes, joins the thread

  void setPaused(bool paused);
  /// Plays one tick, then pauses.
  void stepOnce();
  /// Sets the speed: 1 is real time, unlimitedSpeed as fast as possible.
  void setSpeed(double timesRealTime);
  /// Plays at full speed up to this tick, then pauses; for tests and repeatable pictures.
  void runTo(std::uint64_t tick);
  /// Plays at full speed until an event that `wanted` accepts, for `maxTicks` at most, and then
  /// continues as before: paused, or at its speed. setPaused(), stepOnce() and runTo() end it.
  /// `wanted` is called on the runner's thread.
  void skip(std::function<bool(const MatchEvent&)> wanted, std::uint64_t maxTicks);
  /// Waits until the match is paused or over. Returns false if it still plays after that time.
  bool waitUntilStill(std::chrono::milliseconds timeout) const;

  /// Queues a command for the runner's thread. It runs between two ticks, also while paused.
  using Command = std::function<Changed(SimulatedMatch&)>;
  void post(Command command);
  /// The same, and waits until it has run. Do not call it from within a command.
  void execute(const Command& command);
  /// Runs a function that changes nothing on the runner's thread, and waits for it.
  void read(const std::function<void(const SimulatedMatch&)>& look);

  /// Adds an observer, which sees the present moment and every later tick until stopObserving().
  /// Both wait for the tick in progress. Do not call them from within a command.
  void observe(const std::shared_ptr<TickObserver>& observer);
  void stopObserving(const std::shared_ptr<TickObserver>& observer);

  /// Sets the function that is called on the runner's thread when there is a new frame, event or
  /// log line. It is called once, and again only after latest(), drainEvents() or drainLog(). An
  /// empty function turns this off, but a call may still be in progress.
  void setNews(std::function<void()> notify);
  /// Returns the newest frame, or null if `knownSerial` is the newest.
  std::shared_ptr<const MatchFrame> latest(std::uint64_t knownSerial = 0);
  /// Both return what came since the last call, at most the newest 10 000.
  std::vector<MatchEvent> drainEvents();
  std::vector<LogLine> drainLog();

  struct Shared;  ///< between the thread and the callers; private to the library

 private:
  explicit MatchRunner(std::shared_ptr<Shared> shared);
  std::shared_ptr<Shared> m_shared;
  std::jthread m_thread;
};

}  // namespace pitchboard::link
