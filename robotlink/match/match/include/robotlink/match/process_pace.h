// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Keeps a simulated match and the separate processes of its robots in time with each other. It
// watches the processes, tells the clocks of team programs the match's time, and slows the match
// down when a team program cannot keep up. Used on the match's thread. Speeds are multiples of real
// time; 0 means "as fast as possible".

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <robotlink/match/match_options.h>
#include <robotlink/match/robot_slots.h>

namespace pitchboard::link {

class MatchEvents;

class ProcessPace {
 public:
  /// Shortest time between two changes of pace for team programs, so that each shows its effect.
  static constexpr std::chrono::seconds paceInterval{3};
  using Time = std::chrono::steady_clock::time_point;

  /// All arguments must outlive this object.
  ProcessPace(MatchBase& base, RobotSlots& robots, MatchEvents& events);

  // As in MatchOptions; may be changed during the match.
  RobotsPace robotsPace;
  bool waitForTeamPrograms;

  /// Restarts processes that died, reports those that do not respond, and tells the clocks of team
  /// programs the match's time and the speed that the match reached.
  /// MatchPlayer::lookAfterProcesses() says how often to call it.
  void lookAfterProcesses(Time now);
  /// Sets how the match is played from now on: at this speed, or not at all while `still`.
  void setPlaying(double speed, bool still, Time now);
  /// Plays more slowly for now, because team programs cannot keep up. Their clocks follow.
  void slowTo(double speed, Time now);
  /// Called after each tick. Team programs see the time that has been played in all; restoring a
  /// saved moment does not set it back.
  void countTick() { ++m_ticks; }
  /// Returns whether the match waits for separate reference processes in every tick.
  bool inLockStep() const;
  /// Returns whether there is a process for whose cycles the match waits now.
  bool waitsForProcesses() const;

  // Team programs.
  /// Returns the pace to use next, between the current pace `now` and the wanted one. It is not
  /// above what the slowest team program manages, and rises again in steps. It exceeds real time
  /// only if the clocks of all programs can follow. "As fast as possible" begins at ×1, where the
  /// normal rate of each program is measured, and doubles as long as all keep up. Returns `wanted`
  /// if the match waits for no program.
  double teamProgramPace(double wanted, double now);
  /// Returns the speed of the slowest team program that cannot keep up; empty if all keep up.
  std::optional<double> slowestTeamProgram() const;
  enum class Await {
    AllPrograms,  ///< also programs that were just started and have not attached to a blackboard
    Cooperating   ///< only programs that report the end of each cycle
  };
  /// Returns true while the match has to wait for a program to get ready. A cooperating program is
  /// ready once it has reported so; the clocks of programs run at ×1 meanwhile. Call it and
  /// lookAfterProcesses() until it returns false: then all programs are ready, have ended, or were
  /// given up after their `response_timeout` (at least 10 s), which an event reports.
  bool awaitsPrograms(Await whom, Time now);
  /// Returns whether the program, or one that it started, has attached to its robot's blackboard.
  bool hasAttached(const ProcessStatus& program) const;
  /// Lets team programs run for this time while the match stands still.
  void letTeamProgramsRun(std::chrono::duration<double> time);
  /// A process that the match had to wait for in lock-step, long enough to be noticed.
  struct Wait {
    RobotId robot;
    std::string process;
    Time at;
  };
  void setWait(Wait wait) { m_wait = std::move(wait); }
  /// Returns the last such wait if it was less than three seconds ago, otherwise null.
  const Wait* waitedFor(Time now) const {
    constexpr std::chrono::seconds shown{3};
    return m_wait && now - m_wait->at < shown ? &*m_wait : nullptr;
  }
  /// Reports, as an event, that the robot's program did not finish its cycle in time.
  void reportLateCycle(const RobotSlot& slot);
  bool standsStill() const { return m_still; }

 private:
  bool isAwaited(const RobotSlot& slot, SlotProcess& process, Time now);
  bool awaitsFirstCycle(RobotSlot& slot, Time now);
  bool cooperates(const ProcessStatus& program) const;
  void measureFrom(Time now);
  void publishTime(Time now);
  double playedSeconds() const;

  MatchBase& m_base;
  RobotSlots& m_slots;
  MatchEvents& m_events;
  double m_speed = 0.0;
  bool m_still = false;
  double m_pace = 0.0;        // requested pace: m_speed, or slower
  double m_reached = 1.0;     // measured pace, times real time
  bool m_hasSlowed = false;   // for team programs, since m_speed was set
  std::uint64_t m_ticks = 0;  // played
  double m_awaited = 0.0;     // s for which the match has waited for programs at ×1
  std::optional<Time> m_awaitedAt;
  std::optional<Wait> m_wait;
  Time m_measured{};  // when m_reached was measured
  double m_measuredSeconds = 0.0;
};

}  // namespace pitchboard::link
