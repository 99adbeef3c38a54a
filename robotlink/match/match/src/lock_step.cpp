// SPDX-License-Identifier: GPL-3.0-or-later
#include "lock_step.h"

#include <algorithm>
#include <thread>

#include <robotlink/processes/lock_step_orders.h>

#include "match_base.h"

namespace pitchboard::link {
namespace {

using namespace std::chrono_literals;
using SteadyClock = std::chrono::steady_clock;
using Seconds = RestartRule::Seconds;

constexpr auto glance = 20ms;  // between two looks at the processes while one is waited for
constexpr auto worthReporting = 250ms;
constexpr Seconds minTimeToStart{10.0};  // of a process on a busy computer
constexpr auto worthWaiting = 1s;        // for a restart; otherwise the match continues without it

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
  if (m_slots.lockStepSlots() && inLockStep) runCycles();
  const std::uint64_t now = m_base.tick();
  const link::Clock clock{static_cast<double>(now) / m_base.tickRate()};
  for (const auto& slot : m_slots.all()) {
    for (const auto& process : slot->processes) {
      if (process->isSeparateReference()) {
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

void LockStep::beginAnew(const RobotSlot& slot) {
  for (const auto& process : slot.processes) {
    if (process->isSeparateReference()) m_anew.insert(process->id);
  }
}

void LockStep::planNext(SlotProcess& process) const {
  process.nextTick = nextDueTick(process.period, m_base.tick(), m_base.tickRate());
}

/// Returns whether a cycle is due after this tick. `period` is empty until the process is ready.
bool LockStep::dueNow(SlotProcess& process, std::optional<double> period) const {
  if (!process.known && period) {
    process.known = true;
    process.period = *period;
    // Cycles lie on multiples of the period since the start, however late the process was ready.
    process.nextTick = nextDueTick(process.period, process.startTick, m_base.tickRate());
  }
  return process.known && m_base.tick() >= process.nextTick;
}

void LockStep::startCycle(RobotSlot& slot, SlotProcess& process, bool lockStep) {
  std::vector<std::string> messages;
  if (lockStep && isTeam(process)) messages = m_slots.teamChannel(slot.id)->take(slot.id);
  if (m_anew.erase(process.id) > 0) messages.emplace(messages.begin(), beginAnewOrder);
  m_slots.lockStepSlots()->startCycle(process.lockStepSlot,
                                      static_cast<double>(m_base.tick()) / m_base.tickRate(),
                                      lockStep, messages);
  process.given = true;
  process.givenAt = SteadyClock::now();
}

void LockStep::runFreely(RobotSlot& slot, SlotProcess& process) {
  if (process.lockStepSlot < 0) return;
  const auto period = m_slots.lockStepSlots()->period(process.lockStepSlot);
  if (!dueNow(process, period) || !period) return;
  const auto now = SteadyClock::now();
  if (!m_slots.lockStepSlots()->isDone(process.lockStepSlot)) {
    // The last cycle is still running, so this one is skipped, as on a robot.
    if (now - process.givenAt > Seconds(process.profile.responseTimeout)) {
      m_slots.processes().setResponding(process.id, false, now);
    }
    return;
  }
  m_slots.processes().setResponding(process.id, true, now);
  startCycle(slot, process, false);
  process.given = false;
  planNext(process);
}

/// In lock-step: the processes of a robot run one after another, those of different robots at the
/// same time. Within a tick robots exchange nothing but team messages, so only the process `team`
/// runs robot by robot. The result is the same as if all cycles ran one after another.
void LockStep::runCycles() {
  for (const auto& slot : m_slots.all()) slot->current = 0;
  bool left = true;
  while (left) {
    left = false;
    for (const auto& slot : m_slots.all()) {
      if (slot->current >= slot->processes.size()) continue;
      SlotProcess& process = *slot->processes[slot->current];
      if (process.isSeparateReference() && !isTeam(process)) giveIfReady(*slot, process);
    }
    bool teamsDone = true;  // of all robots before this one
    for (const auto& slot : m_slots.all()) {
      auto& processes = slot->processes;
      if (slot->current < processes.size() && (teamsDone || !isTeam(*processes[slot->current]))) {
        SlotProcess& process = *processes[slot->current++];
        if (process.isSeparateReference()) runSeparate(*slot, process);
      }
      left = left || slot->current < processes.size();
      teamsDone =
          teamsDone && std::none_of(processes.begin() + static_cast<std::ptrdiff_t>(slot->current),
                                    processes.end(), [](const auto& one) { return isTeam(*one); });
    }
  }
}

/// Ahead of runSeparate(), which waits until it is done.
void LockStep::giveIfReady(RobotSlot& slot, SlotProcess& process) {
  if (process.given || process.lockStepSlot < 0 ||
      (process.known && m_base.tick() < process.nextTick)) {
    return;
  }
  const ProcessStatus* status = m_slots.processes().status(process.id);
  if (!status || status->state != ProcessState::Running) return;
  const auto period = m_slots.lockStepSlots()->period(process.lockStepSlot);
  if (period && m_slots.lockStepSlots()->isDone(process.lockStepSlot) && dueNow(process, period)) {
    startCycle(slot, process, true);
  }
}

/// In lock-step: returns when the cycle is complete or the process has taken too long.
void LockStep::runSeparate(RobotSlot& slot, SlotProcess& process) {
  if (process.known && m_base.tick() < process.nextTick) return;
  LockStepSlots& shared = *m_slots.lockStepSlots();
  ProcessManager& processes = m_slots.processes();
  const auto begin = SteadyClock::now();
  const Seconds patience = std::max(Seconds(process.profile.responseTimeout), minTimeToStart);
  while (true) {
    const ProcessStatus* status = processes.status(process.id);
    const auto now = SteadyClock::now();
    const bool comes = status && comesSoon(*status, process.profile, now);
    if (!comes) {
      // A process that was given up may respond again by itself.
      if (status && status->state == ProcessState::NotResponding && process.lockStepSlot >= 0 &&
          shared.isDone(process.lockStepSlot)) {
        processes.setResponding(process.id, true, now);
        continue;
      }
      return;
    }
    if (process.lockStepSlot < 0 || status->state != ProcessState::Running) {
      std::this_thread::sleep_for(1ms);
    } else if (shared.waitUntilReady(process.lockStepSlot, glance) &&
               shared.waitUntilDone(process.lockStepSlot, glance)) {
      if (process.given) break;
      if (!dueNow(process, shared.period(process.lockStepSlot))) return;
      startCycle(slot, process, true);
      if (shared.waitUntilDone(process.lockStepSlot, glance)) break;
    }
    const auto waited = SteadyClock::now() - begin;
    const bool overdue = process.given && waited > Seconds(process.profile.responseTimeout);
    if (overdue || waited > patience) {
      processes.setResponding(process.id, false, SteadyClock::now());
      process.given = false;
      return;
    }
    // This also reads the output of processes, because a full pipe would block them.
    if (waited > glance) m_pace.lookAfterProcesses(SteadyClock::now());
    if (waited > worthReporting) {
      m_pace.setWait({slot.id, process.profile.name, SteadyClock::now()});
    }
  }
  process.given = false;
  processes.setResponding(process.id, true, SteadyClock::now());
  planNext(process);
  for (const std::string& message : shared.drainPosted(process.lockStepSlot)) {
    m_slots.teamChannel(slot.id)->post(slot.id, message);
  }
}

}  // namespace pitchboard::link
