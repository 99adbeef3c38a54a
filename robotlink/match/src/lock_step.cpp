// SPDX-License-Identifier: GPL-3.0-or-later
#include "lock_step.h"

#include <algorithm>
#include <thread>

#include "match_base.h"

namespace pitchboard::link {
namespace {

using namespace std::chrono_literals;
using SteadyClock = std::chrono::steady_clock;
using Seconds = RestartRule::Seconds;

constexpr auto glance = 20ms;  // between two looks at the processes while one is waited for
constexpr auto worthTelling = 250ms;
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

bool isTeam(const SlotProcess& process) {
  return process.profile.reference == "team";
}

}  // namespace

void LockStep::run() {
  m_pace.countTick();
  const bool inLockStep = m_pace.inLockStep();
  if (m_slots.turns() && inLockStep) takeTurns();
  const std::uint64_t now = m_base.tick();
  const link::Clock clock{static_cast<double>(now) / m_base.tickRate()};
  for (const auto& slot : m_slots.all()) {
    for (const auto& process : slot->processes) {
      if (process->takesTurns()) {
        if (!inLockStep) runFreely(*slot, *process);
      } else if (process->inside && now >= process->nextTick) {
        process->inside->step(slot->board, clock);
        planNext(*process);
      }
    }
  }
  m_cycles.run();
}

void LockStep::jump() {
  m_cycles.jump();
  for (const auto& slot : m_slots.all()) {
    for (const auto& process : slot->processes) {
      if (process->known) planNext(*process);
    }
  }
}

void LockStep::planNext(SlotProcess& process) const {
  process.nextTick = nextDueTick(process.period, m_base.tick(), m_base.tickRate());
}

/// Whether it wants a turn after this tick; `period` as soon as it has told.
bool LockStep::dueNow(SlotProcess& process, std::optional<double> period) const {
  if (!process.known && period) {
    process.known = true;
    process.period = *period;
    // As if it had been there since it was started: turns lie on multiples of the period.
    process.nextTick = nextDueTick(process.period, process.startTick, m_base.tickRate());
  }
  return process.known && m_base.tick() >= process.nextTick;
}

void LockStep::giveTurn(RobotSlot& slot, SlotProcess& process, bool lockStep) {
  std::vector<std::string> messages;
  if (lockStep && isTeam(process)) messages = m_slots.teamChannel(slot.id)->take(slot.id);
  m_slots.turns()->give(process.place, static_cast<double>(m_base.tick()) / m_base.tickRate(),
                        lockStep, messages);
  process.given = true;
  process.givenAt = SteadyClock::now();
}

void LockStep::runFreely(RobotSlot& slot, SlotProcess& process) {
  if (process.place < 0) return;
  const auto period = m_slots.turns()->period(process.place);
  if (!dueNow(process, period) || !period) return;
  const auto now = SteadyClock::now();
  if (!m_slots.turns()->isDone(process.place)) {
    // Late; a cycle that was missed is left out, as on the field.
    if (now - process.givenAt > Seconds(process.profile.silentAfter)) {
      m_slots.processes().setSilent(process.id, true, now);
    }
    return;
  }
  m_slots.processes().setSilent(process.id, false, now);
  giveTurn(slot, process, false);
  process.given = false;
  planNext(process);
}

/// In lock-step: each robot's processes one behind the other, those of different robots side by
/// side. What robots have of each other within a tick are team messages alone, so `team` has its
/// turn robot by robot: the result is that of all turns one behind the other.
void LockStep::takeTurns() {
  for (const auto& slot : m_slots.all()) slot->turn = 0;
  bool left = true;
  while (left) {
    left = false;
    for (const auto& slot : m_slots.all()) {
      if (slot->turn >= slot->processes.size()) continue;
      SlotProcess& process = *slot->processes[slot->turn];
      if (process.takesTurns() && !isTeam(process)) giveIfReady(*slot, process);
    }
    bool teamsDone = true;  // of all robots before this one
    for (const auto& slot : m_slots.all()) {
      auto& processes = slot->processes;
      if (slot->turn < processes.size() && (teamsDone || !isTeam(*processes[slot->turn]))) {
        SlotProcess& process = *processes[slot->turn++];
        if (process.takesTurns()) runSeparate(*slot, process);
      }
      left = left || slot->turn < processes.size();
      teamsDone =
          teamsDone && std::none_of(processes.begin() + static_cast<std::ptrdiff_t>(slot->turn),
                                    processes.end(), [](const auto& one) { return isTeam(*one); });
    }
  }
}

/// Ahead of runSeparate(), which waits until it is done.
void LockStep::giveIfReady(RobotSlot& slot, SlotProcess& process) {
  if (process.given || process.place < 0 || (process.known && m_base.tick() < process.nextTick)) {
    return;
  }
  const ProcessStatus* status = m_slots.processes().status(process.id);
  if (!status || status->state != ProcessState::Running) return;
  const auto period = m_slots.turns()->period(process.place);
  if (period && m_slots.turns()->isDone(process.place) && dueNow(process, period)) {
    giveTurn(slot, process, true);
  }
}

/// In lock-step. Returns when the turn is done, or when it cannot be waited for any longer.
void LockStep::runSeparate(RobotSlot& slot, SlotProcess& process) {
  if (process.known && m_base.tick() < process.nextTick) return;
  MatchTurns& turns = *m_slots.turns();
  ProcessManager& processes = m_slots.processes();
  const auto begin = SteadyClock::now();
  const Seconds patience = std::max(Seconds(process.profile.silentAfter), leastTimeToStart);
  while (true) {
    const ProcessStatus* status = processes.status(process.id);
    const auto now = SteadyClock::now();
    const bool comes = status && comesSoon(*status, process.profile, now);
    if (!comes) {
      // One that was given up for silent may have come back by itself.
      if (status && status->state == ProcessState::Silent && process.place >= 0 &&
          turns.isDone(process.place)) {
        processes.setSilent(process.id, false, now);
        continue;
      }
      return;
    }
    if (process.place < 0 || status->state != ProcessState::Running) {
      std::this_thread::sleep_for(1ms);
    } else if (turns.waitUntilReady(process.place, glance) &&
               turns.waitUntilDone(process.place, glance)) {
      if (process.given) break;
      if (!dueNow(process, turns.period(process.place))) return;
      giveTurn(slot, process, true);
      if (turns.waitUntilDone(process.place, glance)) break;
    }
    const auto waited = SteadyClock::now() - begin;
    const bool silent = process.given && waited > Seconds(process.profile.silentAfter);
    if (silent || waited > patience) {
      processes.setSilent(process.id, true, SteadyClock::now());
      process.given = false;
      return;
    }
    // Also reads what it writes: a full pipe would hold it up.
    if (waited > glance) m_pace.lookAfterProcesses(SteadyClock::now());
    if (waited > worthTelling) {
      m_pace.tellWait({slot.id, process.profile.name, SteadyClock::now()});
    }
  }
  process.given = false;
  processes.setSilent(process.id, false, SteadyClock::now());
  planNext(process);
  for (const std::string& message : turns.takePosted(process.place)) {
    m_slots.teamChannel(slot.id)->post(slot.id, message);
  }
}

}  // namespace pitchboard::link
