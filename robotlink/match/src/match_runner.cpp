// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/match/match_runner.h>

#include <future>
#include <iterator>

#include "match_loop.h"

namespace pitchboard::link {
namespace {

/// Far above what any machine reaches; also keeps the pacer's arithmetic finite.
double limitedSpeed(double timesRealTime) {
  const bool limited = timesRealTime > 0.0 && timesRealTime < 1e6;
  return limited ? timesRealTime : MatchRunner::unlimitedSpeed;
}

}  // namespace

Result<std::unique_ptr<MatchRunner>> MatchRunner::start(
    const Scenario& scenario, const MatchOptions& options, bool paused,
    const VariableCatalog& catalog, std::vector<std::shared_ptr<TickObserver>> observers) {
  auto shared = std::make_shared<Shared>();
  shared->paused = paused;
  shared->speed = limitedSpeed(options.speed);
  std::unique_ptr<MatchRunner> runner(new MatchRunner(shared));
  std::promise<Result<void>> made;
  auto outcome = made.get_future();
  // `scenario` and `options` are only used before the promise is kept, while this call waits.
  runner->m_thread =
      std::jthread([&scenario, &options, &catalog, shared, observers = std::move(observers),
                    promise = std::move(made)](const std::stop_token& stop) mutable {
        auto match = SimulatedMatch::create(scenario, options, catalog);
        if (!match) {
          promise.set_value(tl::unexpected(match.error()));
          return;
        }
        MatchLoop loop(*shared, std::move(*match));
        for (auto& observer : observers) loop.player().observe(std::move(observer));
        shared->loop = &loop;
        loop.publish();
        promise.set_value({});
        loop.run(stop);
      });
  if (auto started = outcome.get(); !started) return tl::unexpected(started.error());
  return runner;
}

MatchRunner::MatchRunner(std::shared_ptr<Shared> shared) : m_shared(std::move(shared)) {}

MatchRunner::~MatchRunner() {
  m_thread.request_stop();
  if (m_thread.joinable()) m_thread.join();
  // What was not carried out any more: lets go of callers that wait in execute().
  const std::lock_guard lock(m_shared->mutex);
  m_shared->commands.clear();
}

void MatchRunner::setPaused(bool paused) {
  const std::lock_guard lock(m_shared->mutex);
  m_shared->paused = paused;
  m_shared->runTo.reset();
  m_shared->paceChanged = true;
  m_shared->settled = false;
  m_shared->changed.notify_all();
}

void MatchRunner::stepOnce() {
  const std::lock_guard lock(m_shared->mutex);
  m_shared->paused = true;
  m_shared->runTo.reset();
  ++m_shared->singleSteps;
  m_shared->settled = false;
  m_shared->changed.notify_all();
}

void MatchRunner::setSpeed(double timesRealTime) {
  const std::lock_guard lock(m_shared->mutex);
  m_shared->speed = limitedSpeed(timesRealTime);
  m_shared->paceChanged = true;
  m_shared->settled = false;
  m_shared->changed.notify_all();
}

void MatchRunner::runTo(std::uint64_t tick) {
  const std::lock_guard lock(m_shared->mutex);
  m_shared->runTo = tick;
  m_shared->paceChanged = true;
  m_shared->settled = false;
  m_shared->changed.notify_all();
}

bool MatchRunner::waitUntilStill(std::chrono::milliseconds timeout) const {
  std::unique_lock lock(m_shared->mutex);
  return m_shared->stillNow.wait_for(lock, timeout, [this] { return m_shared->settled; });
}

void MatchRunner::post(Command command) {
  const std::lock_guard lock(m_shared->mutex);
  m_shared->commands.push_back(std::move(command));
  m_shared->changed.notify_all();
}

void MatchRunner::execute(const Command& command) {
  const auto task = std::make_shared<std::packaged_task<void(SimulatedMatch&)>>(command);
  const auto done = task->get_future();
  post([task](SimulatedMatch& match) { (*task)(match); });
  done.wait();
}

void MatchRunner::observe(const std::shared_ptr<TickObserver>& observer) {
  execute([this, &observer](SimulatedMatch&) { m_shared->loop->player().observe(observer); });
}

void MatchRunner::stopObserving(const std::shared_ptr<TickObserver>& observer) {
  execute([this, &observer](SimulatedMatch&) { m_shared->loop->player().stopObserving(observer); });
}

std::shared_ptr<const MatchFrame> MatchRunner::latest(std::uint64_t knownSerial) const {
  const std::lock_guard lock(m_shared->mutex);
  const auto& frame = m_shared->latest;
  return frame && frame->serial != knownSerial ? frame : nullptr;
}

std::vector<MatchEvent> MatchRunner::takeEvents() {
  const std::lock_guard lock(m_shared->mutex);
  std::vector<MatchEvent> events(std::make_move_iterator(m_shared->events.begin()),
                                 std::make_move_iterator(m_shared->events.end()));
  m_shared->events.clear();
  return events;
}

std::vector<LogLine> MatchRunner::takeLog() {
  const std::lock_guard lock(m_shared->mutex);
  std::vector<LogLine> log(std::make_move_iterator(m_shared->log.begin()),
                           std::make_move_iterator(m_shared->log.end()));
  m_shared->log.clear();
  return log;
}

}  // namespace pitchboard::link
