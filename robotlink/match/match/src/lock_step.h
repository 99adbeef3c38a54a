// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Starts the cycles of the robots' reference processes that are due after a tick, in lock-step or
// running freely. Match thread. Private to the module.

#include <cstdint>
#include <optional>
#include <set>

#include <robotlink/match/process_pace.h>
#include <robotlink/match/robot_slots.h>

#include "cycle_wait.h"

namespace pitchboard::link {

class LockStep {
 public:
  /// All outlive it.
  LockStep(const MatchBase& base, RobotSlots& slots, ProcessPace& pace)
      : m_base(base), m_slots(slots), m_pace(pace), m_cycles(base, slots, pace) {}

  /// After a tick, in the order of the robots: each reference process whose period has passed.
  /// Waits for separate ones in lock-step, and for team programs that cooperate, but not forever.
  void run();
  /// Another moment was put back: what is due follows the simulation's time.
  void jump();
  /// The robot's separate processes begin anew in their next cycle, with what stands on its
  /// blackboard.
  void beginAnew(const RobotSlot& slot);

 private:
  void runCycles();
  void giveIfReady(RobotSlot& slot, SlotProcess& process);
  void runSeparate(RobotSlot& slot, SlotProcess& process);
  void runFreely(RobotSlot& slot, SlotProcess& process);
  bool dueNow(SlotProcess& process, std::optional<double> period) const;
  void planNext(SlotProcess& process) const;
  void startCycle(RobotSlot& slot, SlotProcess& process, bool lockStep);

  const MatchBase& m_base;
  RobotSlots& m_slots;
  ProcessPace& m_pace;
  CycleWait m_cycles;
  std::set<int> m_anew;  // processes that begin anew, by their ids
};

}  // namespace pitchboard::link
