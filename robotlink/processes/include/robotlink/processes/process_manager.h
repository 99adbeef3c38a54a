// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The management process of a robot (SYSTEM.md section 1): starts its other processes in order,
// starts one again that died or that shows no sign of life, and ends all of them.
//
// Signs of life. A process that has a *_WORKING variable sets it in every cycle; communication
// clears it once a second. When it stays 0 for `silentAfter`, the process counts as silent.
// (Without communication among the processes nobody would clear the flags, so the manager does.) A
// process without such a variable is silent while the kernel counts no more of its sleeps, whether
// it is stopped or calculates for ever.
//
// A process that has to be started again waits first: `firstWait`, twice as long every time, at
// most `longestWait`; after `steadyAfter` of work it counts as sound again.

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <robotlink/blackboard/robot_variables.h>
#include <robotlink/processes/process_supervisor.h>

namespace pitchboard::link {

struct ManagedProcess {
  std::string name;                  ///< for people: "decision"
  std::vector<std::string> command;  ///< program and arguments
  IntVar workingFlag{-1};            ///< *_WORKING; absent: by the kernel's count
};

struct ManagerTiming {
  using Seconds = std::chrono::duration<double>;
  Seconds startInterval{0.2};  ///< between the starts of two processes
  Seconds silentAfter{5.0};
  Seconds firstWait{0.5}, longestWait{10.0}, steadyAfter{30.0};
};

/// Use from one thread, which must live as long as the processes (see ProcessSupervisor).
class ProcessManager {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// `board` must outlive the manager. `clearFlags`: no process of the list clears *_WORKING.
  ProcessManager(RobotId robot, std::vector<ManagedProcess> processes, const ManagerTiming& timing,
                 Blackboard& board, bool clearFlags);
  ~ProcessManager();  ///< stop()

  /// Starts what is due, collects what ended, looks for signs of life. Call it about 20 times a
  /// second; it waits only while a silent process is being ended (at most half a second). An error
  /// is a program that cannot be executed at its first start; a restart is tried again instead.
  Result<void> step(Time now);
  /// Ends all; returns when they are gone.
  void stop();

  /// Sentences about starts, ends and restarts, and the processes' own output, since the last call.
  std::vector<std::string> takeMessages();
  /// Process number, or 0 while it does not run; in the order given. For tests.
  std::vector<pid_t> pids() const;
  /// How often one of them was started again.
  int restarts() const { return m_restarts; }

 private:
  struct Entry {
    ManagedProcess process;
    int handle = 0;  // of the running child, 0 = none
    bool everStarted = false;
    Time due{};  // of the next start
    Time started{}, lastSign{};
    ManagerTiming::Seconds wait{};
    std::uint64_t sleeps = 0;
  };
  Result<void> startDue(Time now);
  Result<void> start(Entry& entry, Time now);
  void collectEnded(Time now);
  void watch(Entry& entry, Time now);
  void plan(Entry& entry, Time now, const std::string& what);
  void takeOutput();
  const ChildStatus* child(int handle) const;

  RobotId m_robot;
  std::vector<Entry> m_entries;
  ManagerTiming m_timing;
  Blackboard& m_board;
  bool m_clearFlags;
  std::optional<Time> m_last;
  Time m_nextStart{};
  std::vector<std::string> m_messages;
  int m_restarts = 0;
  ProcessSupervisor m_supervisor;
};

}  // namespace pitchboard::link
