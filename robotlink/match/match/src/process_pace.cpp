// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/match/process_pace.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "match_base.h"
#include "match_events.h"

namespace pitchboard::link {

ProcessPace::ProcessPace(MatchBase& base, RobotSlots& robots, MatchEvents& events)
    : robotsPace(base.options.pace),
      waitForTeamPrograms(base.options.waitForTeamPrograms),
      m_base(base),
      m_slots(robots),
      m_events(events) {}

bool ProcessPace::inLockStep() const {
  return robotsPace == RobotsPace::LockStep || m_still || m_speed != 1.0;
}

bool ProcessPace::waitsForProcesses() const {
  return std::ranges::any_of(m_slots.all(), [this](const auto& slot) {
    return slot->cooperates ||
           (inLockStep() && std::ranges::any_of(slot->processes, [](const auto& process) {
              return process->isSeparateReference();
            }));
  });
}

void ProcessPace::lookAfterProcesses(Time now) {
  ProcessManager& processes = m_slots.processes();
  (void)processes.step(now);
  m_events.drainNews(m_base.simulation.state(), processes.drainNews());
  if (!m_still) publishTime(now);
}

/// Clocks and time limits of a team's programs follow what is reached, not what was asked for.
void ProcessPace::publishTime(Time now) {
  using Seconds = RestartRule::Seconds;
  constexpr Seconds window{1.0};
  constexpr double alike = 0.03;
  const Seconds passed = now - m_measured;
  if (passed >= window) {
    const double played = playedSeconds() - m_measuredSeconds;
    if (played > 0.0 && passed < 10 * window) {
      const double asked = m_pace * passed.count();
      const bool asAsked = std::abs(played - asked) < alike * asked + 1.5 / m_base.tickRate();
      m_reached = m_pace > 0.0 && asAsked ? m_pace : played / passed.count();
    }
    measureFrom(now);
  }
  // In the middle of the tick.
  m_slots.processes().setTime(playedSeconds() + 0.5 / m_base.tickRate(), m_reached, now);
}

double ProcessPace::playedSeconds() const {
  return m_awaited + static_cast<double>(m_ticks) / m_base.tickRate();
}

void ProcessPace::measureFrom(Time now) {
  m_measured = now;
  m_measuredSeconds = playedSeconds();
}

void ProcessPace::setPlaying(double speed, bool still, Time now) {
  m_speed = speed;
  m_still = still;
  m_hasSlowed = false;
  slowTo(speed, now);
  m_slots.processes().setPaused(still, now);
}

void ProcessPace::slowTo(double speed, Time now) {
  m_pace = speed;
  if (speed > 0.0) m_reached = speed;
  measureFrom(now);
  publishTime(now);
}

double ProcessPace::teamProgramPace(double wanted, double now) {
  constexpr double search = 2.0, faster = 1.25, least = 0.1, fastest = 1000.0;
  if (!waitForTeamPrograms) return wanted;
  const bool unlimited = wanted == 0.0;
  double most = unlimited ? fastest : wanted;
  bool any = false, unknown = false;
  std::optional<double> slowest;
  for (const ProcessStatus& one : m_slots.processes().statuses()) {
    if (!one.isTeamProgram || one.pid == 0 || cooperates(one)) continue;
    any = true;
    if (one.clock != ProcessClock::Match) {
      most = std::min(most, 1.0);  // slower does not help it either
    } else if (one.achieved == 0.0) {
      unknown = true;
    } else if (fallsBehind(one)) {
      slowest = std::min(slowest.value_or(one.achieved), one.achieved);
    }
  }
  if (!any) return wanted;
  m_hasSlowed = m_hasSlowed || slowest;
  if (slowest) return std::max(least, std::min(*slowest, most));
  if (unlimited && now == 0.0) return 1.0;
  if (unlimited && unknown) return std::min(most, now);
  return std::min(most, now * (unlimited && !m_hasSlowed ? search : faster));
}

std::optional<double> ProcessPace::slowestTeamProgram() const {
  std::optional<double> slowest;
  for (const ProcessStatus& one : m_slots.processes().statuses()) {
    if (fallsBehind(one) && !cooperates(one))
      slowest = std::min(slowest.value_or(one.achieved), one.achieved);
  }
  return slowest;
}

bool ProcessPace::awaitsPrograms(Await whom, Time now) {
  bool awaits = false;
  for (const auto& slot : m_slots.all()) {
    if (slot->cycle.index >= 0) {
      awaits = awaitsFirstCycle(*slot, now) || awaits;
      continue;
    }
    if (whom == Await::Cooperating) continue;
    for (const auto& process : slot->processes) {
      const bool program = !process->inside && !process->profile.isReference();
      if (program && !process->settled) awaits = isAwaited(*slot, *process, now) || awaits;
    }
  }
  if (awaits) {
    // Their time advances meanwhile.
    m_awaited += RestartRule::Seconds(now - m_awaitedAt.value_or(now)).count();
    m_awaitedAt = now;
    m_reached = 1.0;
    measureFrom(now);
    publishTime(now);
  } else {
    m_awaitedAt.reset();
  }
  return awaits;
}

namespace {

using Seconds = RestartRule::Seconds;
constexpr Seconds minPatience{10.0};  // on a busy computer

}  // namespace

/// It plays from its first cycle on.
bool ProcessPace::awaitsFirstCycle(RobotSlot& slot, Time now) {
  if (slot.cooperates || slot.hasMissedCycle) return false;
  if (slot.board.read(slot.cycle) < 0) {
    slot.cooperates = true;
    return false;
  }
  if (!slot.awaitedSince) slot.awaitedSince = now;
  const Seconds waited = now - *slot.awaitedSince;
  if (waited < std::max(minPatience, Seconds(RobotSlots::responseTimeout(slot)))) return true;
  slot.hasMissedCycle = true;
  m_events.lateCycle(m_base.simulation.state(), slot.id,
                     "it has not finished its first cycle after " + inSeconds(waited));
  return false;
}

/// Returns whether the match waits for cycles of this program at every pace.
bool ProcessPace::cooperates(const ProcessStatus& program) const {
  const RobotSlot* slot = m_slots.find(program.robot);
  return slot && slot->cooperates;
}

void ProcessPace::reportLateCycle(const RobotSlot& slot) {
  m_events.lateCycle(
      m_base.simulation.state(), slot.id,
      "no cycle finished for " + inSeconds(Seconds(RobotSlots::responseTimeout(slot))));
}

bool ProcessPace::isAwaited(const RobotSlot& slot, SlotProcess& process, Time now) {
  constexpr int maxRestarts = 2;  // of a program that ends at once
  const ProcessStatus* status = m_slots.processes().status(process.id);
  process.settled = !status || status->state == ProcessState::Stopped || hasAttached(*status);
  if (process.settled) return false;
  if (status->state == ProcessState::Waiting) return true;  // for the one before it
  if (!process.awaitedSince) process.awaitedSince = now;
  const Seconds waited = now - *process.awaitedSince;
  const bool isLost = status->restarts >= maxRestarts || status->state == ProcessState::Ended ||
                      status->state == ProcessState::GivenUp;
  if (!isLost && waited < std::max(minPatience, Seconds(process.profile.responseTimeout))) {
    return true;
  }
  process.settled = true;
  m_events.notAttached(m_base.simulation.state(), slot.id, process.profile.name,
                       "after " + inSeconds(waited) + "; the match " +
                           (process.startTick == 0 ? "starts" : "continues") + " without it");
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
  if (std::ranges::none_of(processes.statuses(), &ProcessStatus::isTeamProgram)) return;
  processes.setPaused(false, std::chrono::steady_clock::now());
  std::this_thread::sleep_for(time);
  processes.setPaused(m_still, std::chrono::steady_clock::now());
}

}  // namespace pitchboard::link
