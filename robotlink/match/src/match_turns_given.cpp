// SPDX-License-Identifier: GPL-3.0-or-later
// The robots' processes in time: whose turn it is after a tick, in lock-step and running freely.
#include <algorithm>
#include <thread>

#include <robotlink/match/own_pace.h>
#include <robotlink/match/simulated_match.h>

#include "match_events.h"
#include "match_seat.h"

namespace pitchboard::link {
namespace {

using namespace std::chrono_literals;
using SteadyClock = std::chrono::steady_clock;
using Seconds = RestartRule::Seconds;

constexpr auto glance = 20ms;  // between two looks at the processes while one is waited for
constexpr Seconds leastTimeToStart{10.0};  // of a process on a busy computer
constexpr auto worthWaiting = 1s;          // for a restart; longer, the match goes on without it

bool comesSoon(const ProcessStatus& status, const ProfileProcess& profile,
               SteadyClock::time_point now) {
  switch (status.state) {
    case ProcessState::Running:
      return true;
    case ProcessState::Waiting:
      return Seconds(profile.delay) <= worthWaiting;
    case ProcessState::Restarting:
      return status.nextStart - now < worthWaiting;
    default:
      return false;
  }
}

bool fallsBehind(const ProcessStatus& program) {
  constexpr double keepsUp = 0.95;
  return program.foreign && program.achieved > 0.0 && program.achieved < keepsUp * program.speed;
}

bool isTeam(const SeatProcess& process) {
  return process.profile.reference == "team";
}

}  // namespace

void SimulatedMatch::runProcesses() {
  if (m_turns && inLockStep()) Seat::takeTurns(*this);
  const std::uint64_t now = m_expectedTick;
  const link::Clock clock{static_cast<double>(now) / m_scenario.settings.tickRate};
  for (const auto& seat : m_seats) {
    for (const auto& process : seat->processes) {
      if (process->takesTurns()) {
        if (!inLockStep()) runFreely(*seat, *process);
      } else if (process->inside && now >= process->nextTick) {
        process->inside->step(seat->board, clock);
        process->nextTick = nextDueTick(process->period, now);
      }
    }
  }
}

/// Whether it wants a turn after this tick; `period` as soon as it has told.
bool SimulatedMatch::dueNow(SeatProcess& process, std::optional<double> period) {
  if (!process.known && period) {
    process.known = true;
    process.period = *period;
    // As if it had been there since it was started: turns lie on multiples of the period.
    process.nextTick = nextDueTick(process.period, process.startTick);
  }
  return process.known && m_expectedTick >= process.nextTick;
}

void SimulatedMatch::giveTurn(Seat& seat, SeatProcess& process, bool lockStep) {
  std::vector<std::string> messages;
  if (lockStep && process.profile.reference == "team") {
    messages = teamChannel(seat.id)->take(seat.id);
  }
  m_turns->give(process.place, static_cast<double>(m_expectedTick) / m_scenario.settings.tickRate,
                lockStep, messages);
  process.given = true;
  process.givenAt = SteadyClock::now();
}

void SimulatedMatch::runFreely(Seat& seat, SeatProcess& process) {
  if (process.place < 0) return;
  const auto period = m_turns->period(process.place);
  if (!dueNow(process, period) || !period) return;
  if (!m_turns->isDone(process.place)) {
    // Late; a cycle that was missed is left out, as on the field.
    const auto now = SteadyClock::now();
    if (now - process.givenAt > Seconds(process.profile.silentAfter)) {
      m_processes->setSilent(process.id, true, now);
    }
    return;
  }
  m_processes->setSilent(process.id, false, SteadyClock::now());
  giveTurn(seat, process, false);
  process.given = false;
  process.nextTick = nextDueTick(process.period, m_expectedTick);
}

/// In lock-step: each robot's processes one behind the other, those of different robots side by
/// side. What robots have of each other within a tick are team messages alone, so `team` has its
/// turn robot by robot: the result is that of all turns one behind the other.
void SimulatedMatch::Seat::takeTurns(SimulatedMatch& match) {
  for (const auto& seat : match.m_seats) seat->turn = 0;
  bool left = true;
  while (left) {
    left = false;
    for (const auto& seat : match.m_seats) {
      if (seat->turn >= seat->processes.size()) continue;
      SeatProcess& process = *seat->processes[seat->turn];
      if (process.takesTurns() && !isTeam(process)) seat->giveIfReady(match, process);
    }
    bool teamsDone = true;  // of all robots before this one
    for (const auto& seat : match.m_seats) {
      auto& processes = seat->processes;
      if (seat->turn < processes.size() && (teamsDone || !isTeam(*processes[seat->turn]))) {
        SeatProcess& process = *processes[seat->turn++];
        if (process.takesTurns()) match.runSeparate(*seat, process);
      }
      left = left || seat->turn < processes.size();
      teamsDone =
          teamsDone && std::none_of(processes.begin() + static_cast<std::ptrdiff_t>(seat->turn),
                                    processes.end(), [](const auto& one) { return isTeam(*one); });
    }
  }
}

/// Ahead of runSeparate(), which waits until it is done.
void SimulatedMatch::Seat::giveIfReady(SimulatedMatch& match, SeatProcess& process) {
  if (process.given || process.place < 0 ||
      (process.known && match.m_expectedTick < process.nextTick)) {
    return;
  }
  const ProcessStatus* status = match.m_processes->status(process.id);
  if (!status || status->state != ProcessState::Running) return;
  const auto period = match.m_turns->period(process.place);
  if (period && match.m_turns->isDone(process.place) && match.dueNow(process, period)) {
    match.giveTurn(*this, process, true);
  }
}

/// In lock-step. Returns when the turn is done, or when it cannot be waited for any longer.
void SimulatedMatch::runSeparate(Seat& seat, SeatProcess& process) {
  if (process.known && m_expectedTick < process.nextTick) return;
  const auto begin = SteadyClock::now();
  const Seconds patience = std::max(Seconds(process.profile.silentAfter), leastTimeToStart);
  while (true) {
    const ProcessStatus* status = m_processes->status(process.id);
    const auto now = SteadyClock::now();
    const bool comes = status && comesSoon(*status, process.profile, now);
    if (!comes) {
      // One that was given up for silent may have come back by itself.
      if (status && status->state == ProcessState::Silent && process.place >= 0 &&
          m_turns->isDone(process.place)) {
        m_processes->setSilent(process.id, false, now);
        continue;
      }
      return;
    }
    if (process.place < 0 || status->state != ProcessState::Running) {
      std::this_thread::sleep_for(1ms);
    } else if (m_turns->waitUntilReady(process.place, glance) &&
               m_turns->waitUntilDone(process.place, glance)) {
      if (process.given) break;
      if (!dueNow(process, m_turns->period(process.place))) return;
      giveTurn(seat, process, true);
      if (m_turns->waitUntilDone(process.place, glance)) break;
    }
    const auto waited = SteadyClock::now() - begin;
    const bool silent = process.given && waited > Seconds(process.profile.silentAfter);
    if (silent || waited > patience) {
      m_processes->setSilent(process.id, true, SteadyClock::now());
      process.given = false;
      return;
    }
    // Also reads what it writes: a full pipe would hold it up.
    if (waited > glance) lookAfterProcesses(SteadyClock::now());
  }
  process.given = false;
  m_processes->setSilent(process.id, false, SteadyClock::now());
  process.nextTick = nextDueTick(process.period, m_expectedTick);
  for (const std::string& message : m_turns->takePosted(process.place)) {
    teamChannel(seat.id)->post(seat.id, message);
  }
}

void SimulatedMatch::lookAfterProcesses(std::chrono::steady_clock::time_point now) {
  constexpr Seconds window{1.0};
  (void)m_processes->step(now);
  m_events->takeNews(m_simulation.state(), m_processes->takeNews());
  if (m_speed != 0.0 || m_still) return;
  // As fast as possible: the clocks of a team's own programs follow what is reached.
  const std::uint64_t tick = m_simulation.state().tick;
  const Seconds passed = now - m_measured;
  if (passed < window) return;
  if (tick > m_measuredTick && passed < 10 * window) {
    const double simulated =
        static_cast<double>(tick - m_measuredTick) / m_scenario.settings.tickRate;
    m_processes->setSpeed(simulated / passed.count(), now);
  }
  m_measured = now;
  m_measuredTick = tick;
}

void SimulatedMatch::setPlaying(double speed, bool still,
                                std::chrono::steady_clock::time_point now) {
  m_speed = speed;
  m_still = still;
  m_measured = now;
  m_measuredTick = m_simulation.state().tick;
  m_processes->setClocksFollow(speed != 1.0);
  if (speed > 0.0) m_processes->setSpeed(speed, now);
  m_processes->setPaused(still, now);
}

void SimulatedMatch::slowTo(double speed, std::chrono::steady_clock::time_point now) {
  m_processes->setSpeed(speed, now);
}

double SimulatedMatch::ownPace(double wanted, double now) const {
  std::optional<double> slowest;
  for (const ProcessStatus& one : m_processes->statuses()) {
    if (!one.foreign || one.pid == 0) continue;
    if (one.clock != ProcessClock::Match) {
      wanted = std::min(wanted, 1.0);  // slower does not help it either
    } else if (fallsBehind(one)) {
      slowest = std::min(slowest.value_or(one.achieved), one.achieved);
    }
  }
  return paceWithOwnPrograms(wanted, now, slowest);
}

std::optional<double> SimulatedMatch::slowestOwnProgram() const {
  std::optional<double> slowest;
  for (const ProcessStatus& one : m_processes->statuses()) {
    if (fallsBehind(one)) slowest = std::min(slowest.value_or(one.achieved), one.achieved);
  }
  return slowest;
}

void SimulatedMatch::letOwnProgramsRun(std::chrono::duration<double> time) {
  const auto& all = m_processes->statuses();
  if (std::none_of(all.begin(), all.end(), [](const ProcessStatus& one) { return one.foreign; })) {
    return;
  }
  m_processes->setPaused(false, SteadyClock::now());
  std::this_thread::sleep_for(time);
  m_processes->setPaused(m_still, SteadyClock::now());
}

}  // namespace pitchboard::link
