// SPDX-License-Identifier: GPL-3.0-or-later
#include "match_loop.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace pitchboard::link {
namespace {

using namespace std::chrono_literals;

constexpr auto longestBatch = 8ms;  // then commands, frames and a stop get their turn
constexpr auto frameInterval = 8ms;
constexpr auto pollInterval = 50ms;
constexpr std::uint64_t noLastTick = std::numeric_limits<std::uint64_t>::max();

template <class T>
void pushBounded(std::deque<T>& queue, T value, std::uint64_t& dropped) {
  queue.push_back(std::move(value));
  if (queue.size() > MatchRunner::Shared::mostQueued) {
    queue.pop_front();
    ++dropped;
  }
}

}  // namespace

std::shared_ptr<MatchFrame> FramePool::take() {
  std::unique_ptr<MatchFrame> frame;
  {
    const std::lock_guard lock(m_mutex);
    if (!m_free.empty()) {
      frame = std::move(m_free.back());
      m_free.pop_back();
    }
  }
  if (!frame) frame = std::make_unique<MatchFrame>();
  return {frame.release(), [pool = weak_from_this()](MatchFrame* used) {
            std::unique_ptr<MatchFrame> owned(used);
            if (const auto alive = pool.lock()) alive->giveBack(std::move(owned));
          }};
}

void FramePool::giveBack(std::unique_ptr<MatchFrame> frame) {
  const std::lock_guard lock(m_mutex);
  if (m_free.size() < mostKept) m_free.push_back(std::move(frame));
}

MatchLoop::MatchLoop(MatchRunner::Shared& shared, SimulatedMatch match)
    : m_shared(shared), m_match(std::move(match)) {
  m_builder.resetSpeed(Clock::now(), m_match.simulation().state().tick);
}

void MatchLoop::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    bool publishNow = carryOutCommands();
    auto now = Clock::now();
    if (now - m_lastPoll >= pollInterval) {
      pollChildren();
      m_lastPoll = now;
      publishNow = publishNow || refreshesWhileStill();
    }
    const auto wake = play(now);
    publishNow = std::exchange(m_publishWanted, false) || publishNow;
    now = Clock::now();
    if (publishNow || (!m_still && now - m_lastPublish >= frameInterval)) publish();

    std::unique_lock lock(m_shared.mutex);
    const auto news = [this] {
      return !m_shared.commands.empty() || m_shared.paceChanged || m_shared.singleSteps > 0;
    };
    if (wake == Clock::time_point::max()) {
      m_shared.changed.wait(lock, stop, news);
    } else if (wake > now) {
      m_shared.changed.wait_until(lock, stop, wake, news);
    }
  }
}

bool MatchLoop::carryOutCommands() {
  std::deque<MatchRunner::Command> commands;
  {
    const std::lock_guard lock(m_shared.mutex);
    commands.swap(m_shared.commands);
  }
  if (commands.empty()) return false;
  const std::uint64_t before = m_match.simulation().hash();
  for (const auto& command : commands) command(m_match);
  if (m_match.simulation().hash() != before) {
    for (const auto& observer : m_observers) observer->worldChanged(m_match);
  }
  // Otherwise the next tick shows what they did.
  if (m_still) showObservers({});
  return true;
}

MatchLoop::Clock::time_point MatchLoop::play(Clock::time_point now) {
  const std::uint64_t tick = m_match.simulation().state().tick;
  std::unique_lock lock(m_shared.mutex);
  const bool finished = m_match.finished();
  const int singleSteps = m_shared.singleSteps;
  if (m_shared.runTo && (tick >= *m_shared.runTo || finished)) {
    m_shared.runTo.reset();
    m_shared.paused = true;
  }
  const std::optional<std::uint64_t> runTo = m_shared.runTo;
  const double speed = runTo ? MatchRunner::unlimitedSpeed : m_shared.speed;
  const bool still = finished || (m_shared.paused && !runTo);
  if (std::exchange(m_shared.paceChanged, false) || still != m_still) {
    m_pacer.start(now, tick,
                  std::max(speed, 1e-6) * m_match.simulation().state().settings.tickRate);
    m_builder.resetSpeed(now, tick);
    m_publishWanted = true;
  }
  m_still = still;
  lock.unlock();
  noteFinish();

  if (singleSteps > 0) {
    for (int i = 0; i < singleSteps && !m_match.finished(); ++i) tickOnce();
    lock.lock();
    m_shared.singleSteps -= singleSteps;
    lock.unlock();
    m_publishWanted = true;
  }
  if (still) {
    return refreshesWhileStill() ? now + pollInterval : Clock::time_point::max();
  }
  if (speed == MatchRunner::unlimitedSpeed) {
    playBatch(now + longestBatch, runTo.value_or(noLastTick));
    return now;
  }
  playBatch(now + longestBatch, m_pacer.target(now));
  const std::uint64_t reached = m_match.simulation().state().tick;
  const auto after = Clock::now();
  m_pacer.forgive(after, reached);
  // Behind by less than is forgiven: go on at once.
  return m_pacer.target(after) > reached ? after : m_pacer.wake(after, reached);
}

void MatchLoop::tickOnce() {
  const auto begin = Clock::now();
  m_match.tick();
  const auto tickTime = Clock::now() - begin;
  const auto events = m_match.simulation().events();
  m_newEvents.insert(m_newEvents.end(), events.begin(), events.end());
  if (!events.empty()) {
    for (const auto& observer : m_observers) observer->happened(events);
  }
  showObservers(tickTime);
}

void MatchLoop::showObservers(std::chrono::nanoseconds tickTime) {
  for (const auto& observer : m_observers) observer->ticked(m_match, tickTime);
}

void MatchLoop::observe(std::shared_ptr<TickObserver> observer) {
  observer->ticked(m_match, {});
  m_observers.push_back(std::move(observer));
}

void MatchLoop::stopObserving(const std::shared_ptr<TickObserver>& observer) {
  std::erase(m_observers, observer);
}

std::uint64_t MatchLoop::playBatch(Clock::time_point until, std::uint64_t lastTick) {
  const auto begin = Clock::now();
  auto now = begin;
  std::uint64_t done = 0;
  while (m_match.simulation().state().tick < lastTick && !m_match.finished()) {
    tickOnce();
    ++done;
    now = Clock::now();
    if (now >= until) break;
  }
  m_builder.addBusy(now - begin, done);
  collectEvents();
  return done;
}

void MatchLoop::collectEvents() {
  if (m_newEvents.empty()) return;
  for (const sim::Event& event : m_newEvents) {
    if (event.kind != sim::EventKind::UnknownAction) continue;
    const auto& robots = m_match.simulation().state().robots;
    const auto index = m_match.simulation().indexOf(event.robot);
    if (!index) continue;
    log(robots[*index].name(),
        "unknown action " + std::to_string(event.value) + " in DECISION_ACTION_A; it stops", true);
  }
  const std::lock_guard lock(m_shared.mutex);
  for (const sim::Event& event : m_newEvents) {
    pushBounded(m_shared.events, event, m_shared.droppedEvents);
  }
  m_newEvents.clear();
}

bool MatchLoop::refreshesWhileStill() const {
  if (!m_match.supervisor().children().empty()) return true;
  const auto& robots = m_match.simulation().state().robots;
  return std::any_of(robots.begin(), robots.end(), [this](const sim::RobotIdentity& robot) {
    const Blackboard* board = m_match.blackboard(robot.id);
    return board && board->key() != 0;
  });
}

void MatchLoop::pollChildren() {
  ProcessSupervisor& supervisor = m_match.supervisor();
  supervisor.poll();
  const auto& children = supervisor.children();
  for (const ChildLine& line : supervisor.takeLines()) {
    const auto child = std::find_if(children.begin(), children.end(),
                                    [&](const auto& c) { return c.handle == line.handle; });
    if (child != children.end()) log(nameOf(child->spec), line.text, false);
  }
  for (std::size_t i = 0; i < children.size(); ++i) {
    if (i >= m_childStates.size()) m_childStates.push_back(ChildState::Running);
    if (std::exchange(m_childStates[i], children[i].state) == children[i].state) continue;
    const bool failed = children[i].state == ChildState::Failed;
    std::string text = failed ? "ended unexpectedly: " : "ended: ";
    text += children[i].detail;
    if (failed && !children[i].lastOutput.empty()) {
      text += "; its last words: " + children[i].lastOutput;
    }
    log(nameOf(children[i].spec), text, failed);
  }
}

std::string MatchLoop::nameOf(const ChildSpec& child) const {
  const auto& robots = m_match.simulation().state().robots;
  const auto index = m_match.simulation().indexOf(child.robot);
  const std::string robot =
      index ? robots[*index].name() : "robot " + std::to_string(child.robot.value);
  return robot + ' ' + child.name;
}

void MatchLoop::noteFinish() {
  const bool finished = m_match.finished();
  if (finished && !m_finishLogged) {
    log("simulation", "the match is over (" + std::string(m_match.finishedBy()) + ")", false);
  }
  m_finishLogged = finished;
}

void MatchLoop::log(const std::string& origin, const std::string& text, bool warning) {
  const sim::WorldState& state = m_match.simulation().state();
  LogLine line{static_cast<double>(state.tick) / state.settings.tickRate, origin, text,
               logLevel(warning)};
  for (const auto& observer : m_observers) observer->logged(line);
  const std::lock_guard lock(m_shared.mutex);
  pushBounded(m_shared.log, std::move(line), m_shared.droppedLogLines);
}

void MatchLoop::publish() {
  collectEvents();
  const auto now = Clock::now();
  m_lastPublish = now;
  const auto frame = m_pool->take();
  m_builder.fill(m_match, now, m_still, *frame);
  frame->serial = ++m_serial;
  std::shared_ptr<const MatchFrame> replaced = frame;
  {
    const std::lock_guard lock(m_shared.mutex);
    frame->paused = m_shared.paused && !m_shared.runTo;
    frame->droppedEvents = m_shared.droppedEvents;
    frame->droppedLogLines = m_shared.droppedLogLines;
    replaced.swap(m_shared.latest);
    m_shared.settled = m_still && !m_shared.paceChanged && m_shared.singleSteps == 0;
  }
  if (m_still) m_shared.stillNow.notify_all();
}

}  // namespace pitchboard::link
