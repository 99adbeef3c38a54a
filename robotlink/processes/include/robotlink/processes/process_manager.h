// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The one supervisor of robots' processes, for a match (studio, command line) and for
// `pitchboard-robot management`: starts them in order, tells what happens to them, starts one again
// that died or that shows no sign of life, ends, stops and continues each of them.
//
// Signs of life, one of four (Watch): a variable of the blackboard that the process keeps setting
// (communication clears it once a second; without communication nobody would, so the manager does);
// the kernel's count of its sleeps, for a process without such a variable; the caller, who knows
// better (a match that gives it turns); or nobody. A process that somebody else stopped (SIGSTOP)
// is silent, too. A team's program that runs on the match's time is given match time to show it,
// and one with a variable is judged only after it has set it once: it may block before its first
// cycle.
//
// A process that has to be started again waits first: `firstWait`, twice as long every time, at
// most `longestWait`; after `steadyAfter` of work it counts as sound again.

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
  enum class Watch { Nobody, Variable, Sleeps, Caller };
  using Seconds = RestartRule::Seconds;

  ChildSpec spec;
  RestartRule restart;
  double delay = 0.0;  ///< s after the start of the robot's process before it
  Watch watch = Watch::Nobody;
  IntVar heartbeat{-1};    ///< with Watch::Variable
  bool clears = false;     ///< the manager clears it
  Seconds silentAfter{5};  ///< or stopped by somebody for so long
  bool watchFile = false;  ///< starts again when its program is replaced
  bool ownTime = false;    ///< a foreign program, whose clocks follow setTime()
  /// Called before every start; may change what is started.
  std::function<Result<void>(ChildSpec&)> prepare{};
};

/// Whose time the clocks of a foreign program tell.
enum class ProcessClock : std::uint8_t {
  Match,          ///< they follow setTime()
  Real,           ///< real time, as its profile asks
  RealNoLibrary,  ///< real time, because our library is not installed
  RealNotLoaded   ///< real time, because our library cannot be loaded into it
};

/// Why the clocks of a program do not follow the match, as a clause; empty if they do.
const char* whyRealTime(ProcessClock clock);

struct ProcessStatus {
  static constexpr std::size_t mostLastLines = 5;
  int id = 0;  ///< unique within a manager
  RobotId robot;
  std::string name;  ///< "decision"
  ProcessState state = ProcessState::Waiting;
  pid_t pid = 0;                                      ///< 0 while it does not run
  int restarts = 0;                                   ///<
  std::string detail;                                 ///< how it ended, why it does not run
  std::vector<std::string> lastLines;                 ///< the newest last
  std::chrono::steady_clock::time_point started{};    ///< the last time
  std::chrono::steady_clock::time_point nextStart{};  ///< while it is Restarting
  double cpu = 0.0;                                   ///< share of a core, of the last second
  std::uint64_t memoryBytes = 0;
  std::optional<double> heartbeatAge{};     ///< s since a sign of life; nothing: nobody watches
  bool foreign = false;                     ///< a program of the team
  ProcessClock clock = ProcessClock::Real;  ///< of a foreign program
  double speed = 0.0;  ///< times real time, that a foreign program is to keep; 0: ours
  /// What it manages of that, times real time: less than `speed` when it cannot keep up, at most 1
  /// when its clocks keep real time. 0: nobody has seen yet how often it works when it can.
  double achieved = 0.0;
  /// Of a foreign program, since it was started: cycles that it did, and those that it would have
  /// done in the same time of its own if it had kept up.
  std::uint64_t cycles = 0, missedCycles = 0;
  bool operator==(const ProcessStatus&) const = default;
};

/// A team's program that does less than 95 % of what it would at the speed that it is to keep.
bool fallsBehind(const ProcessStatus& program);

enum class ProcessNewsKind : std::uint8_t {
  Started,
  Restarted,
  Ended,
  Died,
  Silent,
  GivenUp,
  RealTime  ///< its clocks keep real time at a speed other than ×1; told once
};

/// What happened to a process; words are made from it by those who show it.
struct ProcessNews {
  ProcessNewsKind kind = ProcessNewsKind::Started;
  RobotId robot;
  std::string process;
  pid_t pid = 0;
  std::string detail;       ///< "exit code 2"; of Started: empty
  double restartIn = -1.0;  ///< s; below 0: it is not started again
  std::string lastWords{};  ///< of one that died
};

struct ProcessLine {
  RobotId robot;
  std::string process, text;
};

/// Use from one thread, which must live as long as the processes (see ChildProcess).
class ProcessManager {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::size_t maxLines = 10'000;

  /// `robotProgram` (pitchboard-robot) runs the guard, and the keepers of foreign programs.
  explicit ProcessManager(std::string robotProgram = {});
  ProcessManager(const ProcessManager&) = delete;
  ProcessManager& operator=(const ProcessManager&) = delete;
  ~ProcessManager();  ///< ends all

  /// From now on a guard removes the segments of guardSegment() when this process is killed.
  Result<void> keepGuard();
  /// One that we made.
  void guardSegment(const Blackboard& board);

  /// Behind those that the robot has. Starts it at once when it need not wait for its turn; fails
  /// when it cannot be started, and is then forgotten. `board` must outlive it.
  Result<int> add(const ManagedProcess& process, Blackboard& board, Time now);
  /// Ends all of the robot and forgets them.
  void remove(RobotId robot);
  /// Ends one and forgets it.
  void removeOne(int id);
  /// Ends all; returns when they are gone.
  void stopAll();

  /// Starts what is due, collects what ended, looks for signs of life. Call it about 20 times a
  /// second; it waits only while a silent process is being ended (at most half a second). An error
  /// is a program that could not be executed at its first start; it is tried again, too.
  Result<void> step(Time now);
  /// Readable when a process has ended or has written something, until the next step(); -1 where
  /// the system cannot tell.
  int descriptor() const { return m_epoll.get(); }

  // By hand; an unknown id is nobody.
  void start(int id, Time now);
  void stop(int id);
  void restart(int id, Time now);
  void kill(int id);
  /// With Watch::Caller: it owes a sign of life, or gave one.
  void setSilent(int id, bool silent, Time now);

  /// Foreign programs: stopped and continued with the match. Clocks that keep real time go on
  /// meanwhile, as those of a computer that was suspended.
  void setPaused(bool paused, Time now);
  /// How long the match has been played (s), and how fast it is played, times real time: clocks and
  /// time limits of foreign programs follow. Call it about 20 times a second.
  void setTime(double matchSeconds, double speed, Time now);

  /// All, in the order in which they were added. A new `version()` tells that something changed.
  std::vector<ProcessStatus> statuses() const;
  bool isEmpty() const { return m_entries.empty(); }
  std::uint64_t version() const { return m_version; }
  const ProcessStatus* status(int id) const;
  /// It, or a program that it started, has attached to this System V segment. True where the system
  /// does not let us see it. Costs some milliseconds while it has not.
  bool hasSegment(int id, int shmid) const;
  std::vector<ProcessNews> takeNews();
  /// What they wrote since the last call, the newest 10 000 lines.
  std::vector<ProcessLine> takeLines();
  /// How many lines were dropped because nobody took them.
  std::uint64_t droppedLines() const { return m_droppedLines; }

 private:
  struct Entry {
    ProcessStatus status;
    ManagedProcess process;
    Blackboard* board = nullptr;
    std::optional<ChildProcess> child;  // while it runs
    bool tells = false;                 // the child, m_epoll
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
    bool toldRealTime = false;
  };
  Entry* find(int id);
  Result<void> startDue(Time now);
  Result<void> startNow(Entry& entry, Time now);
  void takeTold();
  std::optional<ChildProcess::End> poll(Entry& entry);
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
  bool isSilent(const Entry& entry, Time now) const;
  static double ownSeconds(const Entry& entry, Time now);
  void lookForLibrary(Entry& entry, Time now);
  void silenced(Entry& entry, Time now, const std::string& detail);
  void addNews(const Entry& entry, ProcessNewsKind kind, const std::string& detail = {});
  void tellGuard(const std::string& line);
  void changed() { ++m_version; }

  std::string m_program;
  UniqueFd m_epoll;  // told by children
  UniqueFd m_guard;  // to the guard; empty: there is none
  pid_t m_guardPid = 0;
  std::vector<Entry> m_entries;
  std::map<RobotId, Time> m_lastStart;  // of a robot's processes, for their order
  std::optional<Time> m_last;
  std::vector<ProcessNews> m_news;
  std::deque<ProcessLine> m_lines;
  std::uint64_t m_droppedLines = 0;
  std::uint64_t m_version = 1;
  int m_nextId = 1;
  bool m_paused = false;
  double m_matchSeconds = 0.0;
  double m_speed = 1.0;
};

/// Words for a time of waiting: "0.2 s".
std::string inSeconds(RestartRule::Seconds seconds);

}  // namespace pitchboard::link
