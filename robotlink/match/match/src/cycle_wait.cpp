// SPDX-License-Identifier: GPL-3.0-or-later
#include "cycle_wait.h"

#include <algorithm>
#include <atomic>
#include <thread>

#include "match_base.h"

namespace pitchboard::link {
namespace {

using namespace std::chrono_literals;

constexpr auto spinning = 50us;  // a program that polls answers within microseconds
constexpr auto nap = 50us;
constexpr auto lookInterval = 20ms;  // at the processes while one is waited for

bool isTeamProgram(const SlotProcess& process) {
  return !process.inside && !process.profile.isReference();
}

}  // namespace

/// True if there is something to wait for.
bool CycleWait::ask(RobotSlot& slot) const {
  if (slot.cycle.index < 0) return false;
  const int done = slot.board.read(slot.cycle);
  const int tick = static_cast<int>(m_base.tick());
  if (done >= 0 || -done >= tick) return false;
  slot.cooperates = true;
  // Behind the percepts.
  std::atomic_thread_fence(std::memory_order_release);
  slot.board.write(slot.cycle, tick);
  return true;
}

bool CycleWait::hasAnswered(const RobotSlot& slot) {
  if (slot.board.read(slot.cycle) >= 0) return false;
  std::atomic_thread_fence(std::memory_order_acquire);
  return true;
}

/// Returns whether a program of the robot runs, or somebody else has to start it.
bool CycleWait::mayAnswer(const RobotSlot& slot) const {
  const auto runs = [this](const auto& process) {
    const ProcessStatus* status = m_slots.processes().status(process->id);
    return isTeamProgram(*process) && status && status->pid != 0;
  };
  return slot.processes.empty() || std::ranges::any_of(slot.processes, runs);
}

void CycleWait::run() {
  m_asked.clear();
  for (const auto& slot : m_slots.all()) {
    if (ask(*slot)) m_asked.push_back(slot.get());
  }
  if (m_asked.empty()) return;
  // A single step of a match that stands still: its programs are stopped.
  ProcessManager& processes = m_slots.processes();
  const bool stopped = m_pace.standsStill();
  if (stopped) processes.setPaused(false, SteadyClock::now());
  await();
  if (stopped) processes.setPaused(true, SteadyClock::now());
}

void CycleWait::await() {
  const auto begin = SteadyClock::now();
  auto looked = begin;
  while (true) {
    std::erase_if(m_asked, [](const RobotSlot* slot) { return hasAnswered(*slot); });
    if (m_asked.empty()) return;
    const auto now = SteadyClock::now();
    if (now - begin < spinning) continue;
    std::this_thread::sleep_for(nap);
    if (now - looked < lookInterval) continue;
    looked = now;
    // Also reads what they write: a full pipe would hold them up.
    m_pace.lookAfterProcesses(now);
    std::erase_if(m_asked, [&](RobotSlot* slot) {
      const RestartRule::Seconds patience(RobotSlots::responseTimeout(*slot));
      if (mayAnswer(*slot) && now - begin < patience) return false;
      slot->hasMissedCycle = true;
      m_pace.reportLateCycle(*slot);
      return true;
    });
  }
}

void CycleWait::jump() {
  for (const auto& slot : m_slots.all()) {
    if (slot->cycle.index < 0 || slot->board.read(slot->cycle) >= 0) continue;
    slot->board.write(slot->cycle, -std::max(1, static_cast<int>(m_base.tick())));
  }
}

}  // namespace pitchboard::link
