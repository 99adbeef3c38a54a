// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How a simulated match and the separate processes of its robots keep time with each other: how it
// is played, and what a team's own programs manage of that. On the match's thread.

#include <chrono>
#include <cstdint>
#include <optional>

#include <robotlink/match/match_options.h>
#include <robotlink/match/robot_slots.h>

namespace pitchboard::link {

class MatchEvents;

class ProcessPace {
 public:
  /// Between two changes for own programs, so that a new pace shows what it does.
  static constexpr std::chrono::seconds ownPaceInterval{3};
  using Time = std::chrono::steady_clock::time_point;

  /// All outlive it.
  ProcessPace(MatchBase& base, RobotSlots& robots, MatchEvents& events);

  // As in MatchOptions; may change while it is played.
  RobotsPace robotsPace;
  bool waitForTeamPrograms;

  /// Starts again what died, notices what is silent, takes what was written. About 20 times a
  /// second, also while the match stands still.
  void lookAfterProcesses(Time now);
  /// How it is played from now on: times real time, 0 = as fast as possible; standing still.
  void setPlaying(double speed, bool still, Time now);
  /// Slower than that for now, because a team's programs cannot keep up: their clocks follow.
  void slowTo(double speed, Time now) { m_slots.processes().setSpeed(speed, now); }
  /// Separate reference processes are waited for in every tick.
  bool inLockStep() const;

  // A team's own programs.
  /// At which pace to go on to `wanted` with them: not above what the
  /// slowest of them manages, and faster again in steps. Faster than real time only when the clocks
  /// of all of them can follow.
  double ownPace(double wanted, double now) const;
  /// Times real time: the slowest of them that cannot keep up; nothing: all do.
  std::optional<double> slowestTeamProgram() const;
  /// One that has just been started has not attached to its blackboard, so that a match without a
  /// pace is to wait; meanwhile the clocks of programs run at ×1. Ask again, and look after the
  /// processes, until it is false: the last one has attached, or ended, or was given up after its
  /// `silent_after`, at least 10 s (an event names it).
  bool awaitsPrograms(Time now);
  /// This program, or one that it started, has attached to the blackboard of its robot.
  bool hasAttached(const ProcessStatus& program) const;
  /// Lets them go on for this time while the match stands still.
  void letTeamProgramsRun(std::chrono::duration<double> time);

 private:
  bool isAwaited(const RobotSlot& slot, SlotProcess& process, Time now);
  void measureFrom(Time now);

  MatchBase& m_base;
  RobotSlots& m_slots;
  MatchEvents& m_events;
  double m_speed = 0.0;
  bool m_still = false;
  Time m_measured{};  // how fast "as fast as possible" is
  std::uint64_t m_measuredTick = 0;
};

}  // namespace pitchboard::link
