// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/match/match_player.h>

#include <algorithm>

namespace pitchboard::link {
namespace {

// Then whoever plays can look after commands, frames, child processes and a stop.
constexpr std::chrono::milliseconds longestBatch{8};
constexpr std::chrono::milliseconds awaitInterval{20};

}  // namespace

void MatchPlayer::observe(std::shared_ptr<TickObserver> observer) {
  observer->ticked(m_match, {});
  m_observers.push_back(std::move(observer));
}

void MatchPlayer::stopObserving(const std::shared_ptr<TickObserver>& observer) {
  if (std::erase(m_observers, observer) > 0) observer->left();
}

void MatchPlayer::setSpeed(double timesRealTime, Clock::time_point now) {
  m_speed = timesRealTime;
  m_pacer.start(now, currentTick(),
                std::max(m_speed, 1e-6) * m_match.simulation().state().settings.tickRate);
}

MatchPlayer::Played MatchPlayer::play(Clock::time_point now, std::uint64_t lastTick) {
  const bool paced = m_speed != unlimitedSpeed;
  const std::uint64_t target = paced ? std::min(m_pacer.target(now), lastTick) : lastTick;
  const auto begin = Clock::now();
  auto reached = begin;
  Played played;
  if (!paced && currentTick() < target && !m_match.finished() && awaitPrograms(now)) {
    played.next = now + awaitInterval;
    return played;
  }
  while (currentTick() < target && !m_match.finished()) {
    tick();
    ++played.ticks;
    reached = Clock::now();
    if (reached >= now + longestBatch) break;
  }
  played.busy = reached - begin;
  played.next = now;
  if (paced) {
    const auto after = Clock::now();
    m_pacer.forgive(after, currentTick());
    // Behind by less than is forgiven: go on at once.
    played.next =
        m_pacer.target(after) > currentTick() ? after : m_pacer.wake(after, currentTick());
  }
  return played;
}

bool MatchPlayer::awaitPrograms(Clock::time_point now) {
  const bool awaits = m_match.pace().awaitsPrograms(now);
  if (awaits && !m_awaits) tick();
  m_awaits = awaits;
  return awaits;
}

void MatchPlayer::tick() {
  const auto begin = Clock::now();
  m_match.tick();
  const auto tickTime = Clock::now() - begin;
  tellEvents();
  for (const auto& observer : m_observers) observer->ticked(m_match, tickTime);
}

void MatchPlayer::tellEvents() {
  m_events.clear();
  m_match.takeEvents(m_events);
  m_drawings.clear();
  m_match.takeDrawings(m_drawings);
  for (const auto& observer : m_observers) {
    if (!m_events.empty()) observer->happened(m_events);
    if (!m_drawings.empty()) observer->drew(m_drawings);
  }
}

void MatchPlayer::showMoment() {
  for (const auto& observer : m_observers) observer->ticked(m_match, {});
}

void MatchPlayer::worldChanged() {
  for (const auto& observer : m_observers) observer->worldChanged(m_match);
}

}  // namespace pitchboard::link
