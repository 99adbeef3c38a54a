// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The word by which a team's program plays in lock-step with the match (docs/robot-programs.md, "A
// program that cooperates"): after each tick the match asks those that have answered so far, all at
// once, and waits for them. Private to the module; on the match's thread.

#include <chrono>
#include <vector>

#include <robotlink/match/process_pace.h>
#include <robotlink/match/robot_slots.h>

namespace pitchboard::link {

class CycleWait {
 public:
  /// All outlive it.
  CycleWait(const MatchBase& base, RobotSlots& slots, ProcessPace& pace)
      : m_base(base), m_slots(slots), m_pace(pace) {}

  /// After a tick. Returns when everybody who was asked has answered, or has had its
  /// `response_timeout` of real time: that one is named, and is not asked again until it answers.
  void run();
  /// Called after another moment was restored: programs have finished only its ticks.
  void jump();

 private:
  using SteadyClock = std::chrono::steady_clock;
  bool ask(RobotSlot& slot) const;
  static bool hasAnswered(const RobotSlot& slot);
  bool mayAnswer(const RobotSlot& slot) const;
  void await();

  const MatchBase& m_base;
  RobotSlots& m_slots;
  ProcessPace& m_pace;
  std::vector<RobotSlot*> m_asked;  // scratch
};

}  // namespace pitchboard::link
