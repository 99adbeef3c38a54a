// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Supervises the processes of robots, for a match (studio, command line) and for
// `pitchboard-robot management`. It starts them in order, reports what happens to them, restarts
// those that die or stop responding, and ends, stops and continues them on request.
//
// ManagedProcess::Watch selects how a process that does not respond is recognized:
//   Variable  The process keeps setting a variable of the blackboard, its heartbeat. Communication
//             clears it once a second; if there is no communication, the manager does (`clears`).
//             A process is judged only once it has set the variable for the first time, because it
//             may block before its first cycle.
//   Sleeps    The kernel's count of the process's sleeps has to grow.
//   Caller    The caller runs the cycles of the process and reports: setResponding().
//   None      The process is not watched.
// A process that somebody else stopped (SIGSTOP) does not respond either. For team programs whose
// clocks follow the match, the time limit is in match time.
//
// Before a restart the manager waits for `firstWait`, then twice as long each time, at most
// `maxWait`. After `steadyAfter` of steady work it starts with `firstWait` again.

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <robotlink/blackboard/robot_variables.h>
#include <robotlink/processes/child_process.h>
#include <robotlink/processes/process_state.h>
#include <robotlink/processes/program_clock.h>
#include <robotlink/processes/runtime_profile.h>

namespace pitchboard::link {

struct ManagedProcess {
  enum class Watch { None, Variable, Sleeps, Caller };
  using Seconds = RestartRule::Seconds;

  ChildSpec spec;
  RestartRule restart;
  double delay = 0.0;  ///< s to wait after the start of the robot's previous process
  Watch watch = Watch::None;
  IntVar heartbeat{-1};        ///< for Watch::Variable
  bool clears = false;         ///< the manager clears the heartbeat
  Seconds responseTimeout{5};  ///< without a sign of life, or stopped by somebody
  bool watchFile = false;      ///< restart when the file of its program is replaced
  bool ownTime = false;        ///< a team program whose clocks follow setTime()
  /// Called before every start; may change `spec`.
  std::function<Result<void>(ChildSpec&)> prepare{};
};

enum class ProcessNewsKind : std::uint8_t {
  Started,
  Restarted,
  Ended,
  Died,
  NotResponding,
  GivenUp,
  RealTime  ///< its clocks show real time although the speed is not ×1; reported once
};

/// Something that happened to a process.
struct ProcessNews {
  ProcessNewsKind kind = ProcessNewsKind::Started;
  RobotId robot;
  std::string process;
  pid_t pid = 0;
  std::string detail;        ///< such as "exit code 2"; empty for Started
  double restartIn = -1.0;   ///< s; below 0: it is not restarted
  std::string lastOutput{};  ///< for Died: what it wrote last
};

/// A line that a process wrote to stdout or stderr.
struct ProcessLine {
  RobotId robot;
  std::string process, text;
  bool isNotice = false;  ///< we say it about the program
};

/// Used on one thread, which must live as long as the processes (see ChildProcess).
class ProcessManager {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::size_t maxLines = 1000;  ///< of each program, until drainLines()

  /// `robotProgram` (pitchboard-robot) runs the guard and the keepers of team programs.
  explicit ProcessManager(std::string robotProgram = {});
  ProcessManager(const ProcessManager&) = delete;
  ProcessManager& operator=(const ProcessManager&) = delete;
  ~ProcessManager();  ///< ends all processes

  /// Starts the guard, which removes the segments of guardSegment() should this program be killed.
  Result<void> keepGuard();
  /// Adds a segment that this program created.
  void guardSegment(const Blackboard& board);

  /// Adds a process after the robot's others and returns its id. Starts it now unless it has to
  /// wait for `delay`; an error means that it could not be started and was not added. `board` must
  /// outlive the process.
  Result<int> add(const ManagedProcess& process, Blackboard& board, Time now);
  /// Ends and removes all processes of the robot.
  void remove(RobotId robot);
  /// Ends and removes a process.
  void removeOne(int id);
  /// Ends all processes and waits until they are gone.
  void stopAll();

  /// Starts processes that are due, collects those that ended, and looks for signs of life. Call it
  /// about 20 times a second. It blocks only while it ends a process that does not respond, for at
  /// most 0.5 s. An error means that a program could not be executed at its first start; it will be
  /// tried again.
  Result<void> step(Time now);
  /// Returns a descriptor that is readable when a process has ended or written something, until the
  /// next step(); -1 if the system does not support it.
  int descriptor() const { return m_epoll.get(); }

  // Requests of the user; an unknown id is ignored.
  void start(int id, Time now);
  void stop(int id);
  void restart(int id, Time now);
  void kill(int id);
  /// For Watch::Caller: reports whether the process responds in time.
  void setResponding(int id, bool responding, Time now);

  /// Stops or continues team programs together with the match. Clocks that show real time advance
  /// meanwhile, as after suspending a computer.
  void setPaused(bool paused, Time now);
  /// Sets how long the match has been played (s) and at which speed (times real time). Clocks and
  /// time limits of team programs follow. Call it about 20 times a second.
  void setTime(double matchSeconds, double speed, Time now);

  /// Returns all processes in the order in which they were added. version() changes with them.
  std::vector<ProcessStatus> statuses() const;
  bool isEmpty() const { return m_entries.empty(); }
  std::uint64_t version() const { return m_version; }
  const ProcessStatus* status(int id) const;
  /// Returns whether the process, or one that it started, has attached to this System V segment;
  /// also true if the system does not let us find out. Takes some milliseconds until it is
  /// attached.
  bool hasSegment(int id, int shmid) const;
  std::vector<ProcessNews> drainNews();
  /// Returns what processes wrote since the last call, the first `maxLines` of each. A notice, once
  /// a second, and ProcessStatus::linesLeftOut count the others.
  std::vector<ProcessLine> drainLines();
  /// Returns how many lines were dropped because they were not taken in time.

 private:
  struct Entry {
    ProcessStatus status;
    ManagedProcess process;
    Blackboard* board = nullptr;
    std::optional<ChildProcess> child;  // while it runs
    bool isWatched = false;             // child is in m_epoll
    bool hasNews = false;
    bool everStarted = false;
    Time due{};  // of the next start
    Time lastSign{}, stoppedSince{};
    double lastSignMatch = 0.0;  // s of the match
    bool everSigned = false;     // since it was started
    RestartRule::Seconds wait{};
    int inARow = 0;  // restarts without steady work in between
    std::uint64_t sleeps = 0;
    double cpuSeconds = 0.0;
    double cyclesPerSecond = 0.0;  // of its own time, while it keeps up; 0: not seen yet
    double readySeconds = 0.0;
    std::uint64_t sampledSleeps = 0;
    Time sampled{};
    double sampledSeconds = 0.0;          // of its own time
    double missedCycles = 0.0;            // before rounding
    std::optional<double> matchStart;     // s of the match at which its own time was 0
    std::string programStamp, newStamp;   // of the program's file when it was started, and since
    std::unique_ptr<ProgramClock> clock;  // null: its clocks keep real time
    bool sawLibrary = false;              // in the program
    bool warnedOfRealTime = false;
    std::size_t waitingLines = 0;   // until drainLines()
    std::uint64_t toldLeftOut = 0;  // lines that are known to be left out
    Time toldAt{};
  };
  Entry* find(int id);
  Result<void> startDue(Time now);
  Result<void> startNow(Entry& entry, Time now);
  void takeEpollEvents();
  std::optional<ChildProcess::End> poll(Entry& entry);
  void tellLeftOut(Entry& entry, Time now);
  void end(const std::vector<Entry*>& entries);
  void ended(Entry& entry, Time now, bool died, const std::string& detail, bool byHand);
  void planRestart(Entry& entry, Time now, ProcessNews news);
  void watch(Entry& entry, Time now);
  void watchFile(Entry& entry, Time now);
  void sample(Entry& entry, Time now);
  void measurePace(Entry& entry, std::uint64_t newSleeps, double share, double ownSeconds);
  void giveClock(Entry& entry, ChildSpec& spec, Time now);
  void askForSpeed(Entry& entry, Time now);
  void steer(Entry& entry, Time now) const;
  void showSign(Entry& entry, Time now) const;
  bool isOverdue(const Entry& entry, Time now) const;
  static double ownSeconds(const Entry& entry, Time now);
  void lookForLibrary(Entry& entry, Time now);
  void reportOverdue(Entry& entry, Time now, const std::string& detail);
  void addNews(const Entry& entry, ProcessNewsKind kind, const std::string& detail = {});
  void sendToGuard(const std::string& line);
  void changed() { ++m_version; }

  std::string m_program;
  UniqueFd m_epoll;  // readable when a child has written or ended
  UniqueFd m_guard;  // to the guard; empty: there is none
  pid_t m_guardPid = 0;
  std::vector<Entry> m_entries;
  std::map<RobotId, Time> m_lastStart;  // of a robot's processes, for their order
  std::optional<Time> m_last;
  std::vector<ProcessNews> m_news;
  std::vector<ProcessLine> m_lines;
  std::uint64_t m_version = 1;
  int m_nextId = 1;
  bool m_paused = false;
  double m_matchSeconds = 0.0;
  double m_speed = 1.0;
};

/// Returns a duration as text: "0.2 s".
std::string inSeconds(RestartRule::Seconds seconds);

}  // namespace pitchboard::link
