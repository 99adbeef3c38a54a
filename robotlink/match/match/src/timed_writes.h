// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The blackboard writes that a scenario plans for times of its match. Private to the module.

#include <cstdint>
#include <variant>
#include <vector>

#include <robotlink/match/due_ticks.h>
#include <robotlink/match/robot_slots.h>

namespace pitchboard::link {

class TimedWrites {
 public:
  /// NotFound when the catalog does not have a variable.
  static Result<TimedWrites> create(const Scenario& scenario, const VariableCatalog& catalog);
  /// Makes those that are due at this tick and were not made yet.
  void applyDue(std::uint64_t tick, const RobotSlots& slots);
  /// What has been written so far for every robot, for one that came later.
  void catchUp(Blackboard& board) const;
  /// Another moment was put back: what is due from this tick on is yet to be made.
  void jumpTo(std::uint64_t tick);

 private:
  struct Write {
    std::uint64_t tick = 0;
    RobotId robot;  // 0: every one
    std::variant<IntVar, FloatVar> variable;
    double value = 0.0;
    void applyTo(Blackboard& board) const;
  };
  std::vector<Write> m_writes;  // in order of tick
  std::size_t m_next = 0;
};

}  // namespace pitchboard::link
