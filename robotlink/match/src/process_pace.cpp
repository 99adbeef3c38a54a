// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/match/process_pace.h>

#include <algorithm>
#include <thread>

#include "match_base.h"
#include "match_events.h"

namespace pitchboard::link {
namespace {

bool fallsBehind(const ProcessStatus& program) {
  constexpr double keepsUp = 0.95;
  return program.foreign && program.achieved > 0.0 && program.achieved < keepsUp * program.speed;
}

}  // namespace

ProcessPace::ProcessPace(MatchBase& base, RobotSlots& robots, MatchEvents& events)
    : robotsPace(base.options.pace),
      waitForTeamPrograms(base.options.waitForTeamPrograms),
      m_base(base),
      m_slots(robots),
      m_events(events) {}

bool ProcessPace::inLockStep() const {
  return robotsPace == RobotsPace::LockStep || m_still || m_speed != 1.0;
}

void ProcessPace::lookAfterProcesses(Time now) {
  using Seconds = RestartRule::Seconds;
  constexpr Seconds window{1.0};
  ProcessManager& processes = m_slots.processes();
  (void)processes.step(now);
  m_events.takeNews(m_base.simulation.state(), processes.takeNews());
  if (m_speed != 0.0 || m_still) return;
  // As fast as possible: the clocks of a team's own programs follow what is reached.
  const Seconds passed = now - m_measured;
  if (passed < window) return;
  if (m_base.tick() > m_measuredTick && passed < 10 * window) {
    const double simulated =
        static_cast<double>(m_base.tick() - m_measuredTick) / m_base.tickRate();
    processes.setSpeed(simulated / passed.count(), now);
  }
  measureFrom(now);
}

void ProcessPace::measureFrom(Time now) {
  m_measured = now;
  m_measuredTick = m_base.tick();
}

void ProcessPace::setPlaying(double speed, bool still, Time now) {
  m_speed = speed;
  m_still = still;
  measureFrom(now);
  ProcessManager& processes = m_slots.processes();
  processes.setClocksFollow(speed != 1.0);
  if (speed > 0.0) processes.setSpeed(speed, now);
  processes.setPaused(still, now);
}

double ProcessPace::ownPace(double wanted, double now) const {
  constexpr double faster = 1.25, least = 0.1;
  std::optional<double> slowest;
  for (const ProcessStatus& one : m_slots.processes().statuses()) {
    if (!one.foreign || one.pid == 0) continue;
    if (one.clock != ProcessClock::Match) {
      wanted = std::min(wanted, 1.0);  // slower does not help it either
    } else if (fallsBehind(one)) {
      slowest = std::min(slowest.value_or(one.achieved), one.achieved);
    }
  }
  return slowest ? std::max(least, std::min(*slowest, wanted)) : std::min(wanted, now * faster);
}

std::optional<double> ProcessPace::slowestTeamProgram() const {
  std::optional<double> slowest;
  for (const ProcessStatus& one : m_slots.processes().statuses()) {
    if (fallsBehind(one)) slowest = std::min(slowest.value_or(one.achieved), one.achieved);
  }
  return slowest;
}

bool ProcessPace::awaitsPrograms(Time now) {
  bool awaits = false;
  for (const auto& slot : m_slots.all()) {
    for (const auto& process : slot->processes) {
      const bool program = !process->inside && !process->profile.isReference();
      if (program && !process->settled) awaits = isAwaited(*slot, *process, now) || awaits;
    }
  }
  if (awaits) {
    m_slots.processes().setSpeed(1.0, now);
    measureFrom(now);  // how fast it is played
  }
  return awaits;
}

bool ProcessPace::isAwaited(const RobotSlot& slot, SlotProcess& process, Time now) {
  using Seconds = RestartRule::Seconds;
  constexpr Seconds leastPatience{10.0};
  constexpr int mostRestarts = 2;  // of a program that ends at once
  const ProcessStatus* status = m_slots.processes().status(process.id);
  process.settled = !status || status->state == ProcessState::Stopped || hasAttached(*status);
  if (process.settled) return false;
  if (status->state == ProcessState::Waiting) return true;  // for the one before it
  if (!process.awaitedSince) process.awaitedSince = now;
  const Seconds waited = now - *process.awaitedSince;
  const bool isLost = status->restarts >= mostRestarts || status->state == ProcessState::Ended ||
                      status->state == ProcessState::GivenUp;
  if (!isLost && waited < std::max(leastPatience, Seconds(process.profile.silentAfter))) {
    return true;
  }
  process.settled = true;
  m_events.notAttached(m_base.simulation.state(), slot.id, process.profile.name,
                       "after " + inSeconds(waited) + "; the match " +
                           (process.startTick == 0 ? "starts" : "goes on") + " without it");
  return false;
}

bool ProcessPace::hasAttached(const ProcessStatus& program) const {
  const RobotSlot* slot = m_slots.find(program.robot);
  if (program.state != ProcessState::Running || !slot) return false;
  const auto segment = SystemVSegments::info(slot->board.key());
  // The match is the first to have it.
  return segment && segment->attached > 1 &&
         m_slots.processes().hasSegment(program.id, segment->shmid);
}

void ProcessPace::letTeamProgramsRun(std::chrono::duration<double> time) {
  ProcessManager& processes = m_slots.processes();
  if (std::ranges::none_of(processes.statuses(), &ProcessStatus::foreign)) return;
  processes.setPaused(false, std::chrono::steady_clock::now());
  std::this_thread::sleep_for(time);
  processes.setPaused(m_still, std::chrono::steady_clock::now());
}

}  // namespace pitchboard::link
