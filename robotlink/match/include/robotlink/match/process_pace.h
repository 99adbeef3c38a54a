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
  /// Between two changes for team programs, so that a new pace shows what it does.
  static constexpr std::chrono::seconds ownPaceInterval{3};
  using Time = std::chrono::steady_clock::time_point;

  /// All outlive it.
  ProcessPace(MatchBase& base, RobotSlots& robots, MatchEvents& events);

  // As in MatchOptions; may change while it is played.
  RobotsPace robotsPace;
  bool waitForTeamPrograms;

  /// Starts again what died, notices what is silent, tells the clocks of team programs the match's
  /// time and the speed that it reached. As often as MatchPlayer::lookAfterProcesses().
  void lookAfterProcesses(Time now);
  /// How it is played from now on: times real time, 0 = as fast as possible; standing still.
  void setPlaying(double speed, bool still, Time now);
  /// Slower than that for now, because a team's programs cannot keep up: their clocks follow. 0 =
  /// as fast as possible.
  void slowTo(double speed, Time now);
  /// After each tick that was played: team programs live in the time that was played, which no
  /// saved moment that is put back changes.
  void countTick() { ++m_ticks; }
  /// Separate reference processes are waited for in every tick.
  bool inLockStep() const;

  // A team's own programs.
  /// At which pace to go on from `now` to `wanted` (0 = as fast as possible) with them: not above
  /// what the slowest of them manages, and faster again in steps. Faster than real time only when
  /// the clocks of all of them can follow. As fast as possible begins at ×1, where it is learned
  /// how often they work when they can, and doubles as long as they keep up. `wanted` if nobody is
  /// waited for.
  double ownPace(double wanted, double now);
  /// Times real time: the slowest of them that cannot keep up; nothing: all do.
  std::optional<double> slowestTeamProgram() const;
  enum class Await {
    Everybody,  ///< who has just been started and has not attached to its blackboard, too
    Cooperating
  };
  /// The match is to wait for a program: for one that cooperates, until it has told that it is
  /// there. Meanwhile the clocks of programs run at ×1. Ask again, and look after the processes,
  /// until it is false: the last one is there, or ended, or was given up after its `silent_after`,
  /// at least 10 s (an event names it).
  bool awaitsPrograms(Await whom, Time now);
  /// This program, or one that it started, has attached to the blackboard of its robot.
  bool hasAttached(const ProcessStatus& program) const;
  /// Lets them go on for this time while the match stands still.
  void letTeamProgramsRun(std::chrono::duration<double> time);
  /// A robot's program did not finish its cycle in time.
  void tellLateCycle(const RobotSlot& slot);
  bool standsStill() const { return m_still; }

 private:
  bool isAwaited(const RobotSlot& slot, SlotProcess& process, Time now);
  bool awaitsFirstCycle(RobotSlot& slot, Time now);
  bool cooperates(const ProcessStatus& program) const;
  void measureFrom(Time now);
  void tellTime(Time now);
  double playedSeconds() const;

  MatchBase& m_base;
  RobotSlots& m_slots;
  MatchEvents& m_events;
  double m_speed = 0.0;
  bool m_still = false;
  double m_pace = 0.0;        // what was asked for: m_speed, or slower
  double m_reached = 1.0;     // of that, times real time
  bool m_hasSlowed = false;   // for team programs, since m_speed was asked for
  std::uint64_t m_ticks = 0;  // played
  double m_awaited = 0.0;     // s in which the match waited for its programs at ×1
  std::optional<Time> m_awaitedAt;
  Time m_measured{};  // m_reached
  double m_measuredSeconds = 0.0;
};

}  // namespace pitchboard::link
