// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/match/match_player.h>

#include <algorithm>
#include <string>

namespace pitchboard::link {
namespace {

// Then the caller can look after commands, frames, child processes and requests to stop.
constexpr std::chrono::milliseconds maxBatch{8};
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
  m_wanted = timesRealTime;
  m_followed = m_wanted == unlimitedSpeed ? Clock::time_point{} : now;
  setPace(timesRealTime, now);
}

void MatchPlayer::setPace(double timesRealTime, Clock::time_point now) {
  m_speed = timesRealTime;
  m_pacer.start(now, currentTick(),
                std::max(m_speed, 1e-6) * m_match.simulation().state().settings.tickRate);
}

/// Slower while a team's own programs cannot keep up, and faster again.
void MatchPlayer::followPrograms(Clock::time_point now) {
  constexpr std::chrono::seconds searchInterval{1};
  const bool unlimited = m_wanted == unlimitedSpeed;
  if (now - m_followed < (unlimited ? searchInterval : ProcessPace::paceInterval)) return;
  m_followed = now;
  const double pace = m_match.pace().teamProgramPace(m_wanted, m_speed);
  if (pace == m_speed) return;
  setPace(pace, now);
  m_match.pace().slowTo(pace, now);
}

MatchPlayer::Played MatchPlayer::play(Clock::time_point now, std::uint64_t lastTick) {
  const auto begin = Clock::now();
  auto reached = begin;
  Played played;
  if (currentTick() < lastTick && !m_match.finished() &&
      await(m_wanted == unlimitedSpeed ? ProcessPace::Await::AllPrograms
                                       : ProcessPace::Await::Cooperating,
            now)) {
    setSpeed(m_wanted, now);  // counts from when they are ready
    played.next = now + awaitInterval;
    return played;
  }
  followPrograms(now);
  const bool paced = m_speed != unlimitedSpeed;
  const std::uint64_t target = paced ? std::min(m_pacer.target(now), lastTick) : lastTick;
  while (currentTick() < target && !m_match.finished()) {
    tick();
    ++played.ticks;
    reached = Clock::now();
    if (reached >= now + maxBatch) break;
  }
  played.busy = reached - begin;
  played.next = now;
  if (paced) {
    const auto after = Clock::now();
    m_pacer.forgive(after, currentTick());
    // The delay is small enough to catch up, so the match continues at once.
    played.next =
        m_pacer.target(after) > currentTick() ? after : m_pacer.wake(after, currentTick());
  }
  return played;
}

bool MatchPlayer::awaitPrograms(Clock::time_point now) {
  return await(ProcessPace::Await::AllPrograms, now);
}

bool MatchPlayer::await(ProcessPace::Await whom, Clock::time_point now) {
  const bool awaits = m_match.pace().awaitsPrograms(whom, now);
  if (awaits && !m_awaits) tick();
  if (!awaits && m_awaits) m_match.pace().slowTo(m_speed, now);  // their clocks ran at ×1 meanwhile
  m_awaits = awaits;
  return awaits;
}

void MatchPlayer::tick() {
  const auto begin = Clock::now();
  m_match.tick();
  const auto tickTime = Clock::now() - begin;
  reportEvents();
  for (const auto& observer : m_observers) observer->ticked(m_match, tickTime);
}

void MatchPlayer::lookAfterProcesses(Clock::time_point now) {
  m_match.pace().lookAfterProcesses(now);
  reportLines(now);
  reportEvents();
}

void MatchPlayer::reportLines(Clock::time_point now) {
  // What our processes say in their first moments is for those who look for it.
  constexpr std::chrono::seconds startingUp{1};
  const auto lines = m_match.robots().processes().drainLines();
  if (lines.empty()) return;
  const sim::Simulation& simulation = m_match.simulation();
  const auto all = m_match.robots().processes().statuses();
  for (const ProcessLine& line : lines) {
    const auto process = std::ranges::find_if(all, [&line](const ProcessStatus& one) {
      return one.robot == line.robot && one.name == line.process;
    });
    const bool starting =
        process != all.end() && !process->isTeamProgram && now - process->started < startingUp;
    const auto index = simulation.indexOf(line.robot);
    const std::string robot = index ? simulation.state().robots[*index].name()
                                    : "robot " + std::to_string(line.robot.value);
    const LogLine entry{simulation.snapshot().time, robot + ' ' + line.process, line.text,
                        line.isNotice ? LogLevel::Warning
                        : starting    ? LogLevel::Debug
                                      : LogLevel::Info};
    for (const auto& observer : m_observers) observer->logged(entry);
  }
}

void MatchPlayer::reportEvents() {
  m_events.clear();
  m_match.drainEvents(m_events);
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
