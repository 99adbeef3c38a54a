// SPDX-License-Identifier: GPL-3.0-or-later
#include "match_loop.h"

#include <algorithm>
#include <utility>

#include <robotlink/match/own_pace.h>

namespace pitchboard::link {
namespace {

using namespace std::chrono_literals;

constexpr auto frameInterval = 8ms;
constexpr auto pollInterval = 50ms;

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
    : m_shared(shared), m_player(std::move(match)), m_match(m_player.match()) {
  m_player.observe(m_newEvents);
  m_builder.resetSpeed(Clock::now(), m_match.simulation().state().tick);
}

void MatchLoop::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    bool publishNow = carryOutCommands();
    auto now = Clock::now();
    if (now - m_lastPoll >= pollInterval) {
      pollProcesses();
      followOwnPrograms(now);
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
  if (m_match.simulation().hash() != before) m_player.worldChanged();
  m_player.tellEvents();
  // Otherwise the next tick shows what they did.
  if (m_still) m_player.showMoment();
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
    m_player.setSpeed(speed, now);
    m_match.setPlaying(speed, still, now);
    m_wantedSpeed = m_speed = speed;
    m_lastFollow = now;
    m_builder.resetSpeed(now, tick);
    m_publishWanted = true;
  }
  m_still = still;
  lock.unlock();

  if (singleSteps > 0) {
    const std::chrono::duration<double> tickTime(1.0 /
                                                 m_match.simulation().state().settings.tickRate);
    for (int i = 0; i < singleSteps && !m_match.finished(); ++i) {
      m_player.tick();
      m_match.letOwnProgramsRun(tickTime);
    }
    lock.lock();
    m_shared.singleSteps -= singleSteps;
    lock.unlock();
    m_publishWanted = true;
  }
  if (still) {
    return refreshesWhileStill() ? now + pollInterval : Clock::time_point::max();
  }
  return playBatch(now, runTo.value_or(MatchPlayer::noLastTick));
}

MatchLoop::Clock::time_point MatchLoop::playBatch(Clock::time_point now, std::uint64_t lastTick) {
  const MatchPlayer::Played played = m_player.play(now, lastTick);
  m_builder.addBusy(played.busy, played.ticks);
  collectEvents();
  return played.next;
}

void MatchLoop::collectEvents() {
  m_player.tellEvents();
  if (m_newEvents->list.empty()) return;
  const std::lock_guard lock(m_shared.mutex);
  for (MatchEvent& event : m_newEvents->list) {
    pushBounded(m_shared.events, std::move(event), m_shared.droppedEvents);
  }
  m_newEvents->list.clear();
}

void MatchLoop::followOwnPrograms(Clock::time_point now) {
  if (m_still || m_wantedSpeed == MatchRunner::unlimitedSpeed ||
      now - m_lastFollow < ownPaceInterval) {
    return;
  }
  m_lastFollow = now;
  const double speed =
      m_match.waitsForOwnPrograms() ? m_match.ownPace(m_wantedSpeed, m_speed) : m_wantedSpeed;
  if (speed == m_speed) return;
  m_speed = speed;
  m_player.setSpeed(speed, now);
  m_match.slowTo(speed, now);
}

bool MatchLoop::refreshesWhileStill() const {
  if (!m_match.processes().statuses().empty()) return true;
  const auto& robots = m_match.simulation().state().robots;
  return std::any_of(robots.begin(), robots.end(), [this](const sim::RobotIdentity& robot) {
    const Blackboard* board = m_match.blackboard(robot.id);
    return board && board->key() != 0;
  });
}

void MatchLoop::pollProcesses() {
  // What a process says in its first moments is for those who look for it.
  constexpr auto startingUp = 1s;
  const auto now = Clock::now();
  m_match.lookAfterProcesses(now);
  const auto& all = m_match.processes().statuses();
  for (const ProcessLine& line : m_match.processes().takeLines()) {
    const auto process = std::find_if(all.begin(), all.end(), [&line](const ProcessStatus& one) {
      return one.robot == line.robot && one.name == line.process;
    });
    const bool starting = process != all.end() && now - process->started < startingUp;
    log(nameOf(line), line.text, starting ? LogLevel::Debug : LogLevel::Info);
  }
  m_player.tellEvents();
}

std::string MatchLoop::nameOf(const ProcessLine& line) const {
  const auto& robots = m_match.simulation().state().robots;
  const auto index = m_match.simulation().indexOf(line.robot);
  const std::string robot =
      index ? robots[*index].name() : "robot " + std::to_string(line.robot.value);
  return robot + ' ' + line.process;
}

void MatchLoop::log(const std::string& origin, const std::string& text, LogLevel level) {
  const sim::WorldState& state = m_match.simulation().state();
  LogLine line{static_cast<double>(state.tick) / state.settings.tickRate, origin, text, level};
  for (const auto& observer : m_player.observers()) observer->logged(line);
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
