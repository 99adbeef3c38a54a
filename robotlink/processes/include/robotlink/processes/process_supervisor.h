// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Starts child processes, notices when one ends, ends them all. A child never outlives this
// process, however that ends (parent-death signal). Use from one thread, which must live as long as
// the children: the kernel sends the signal when the starting THREAD ends.
//
// Every child leads a process group of its own, reads /dev/null, and has its standard output and
// error collected line by line. When it ends, what it started itself ends with it: the rest of its
// group is killed, and of a foreign program also what left the group. A guard, a process of its
// own, does the same when this process is killed, and removes the segments that it was told of.

#include <sys/types.h>
#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include <base/descriptor.h>
#include <base/ids.h>
#include <base/result.h>
#include <robotlink/blackboard/blackboard.h>

namespace pitchboard::link {

struct ChildSpec {
  RobotId robot;
  std::string name;                  ///< for people: "decision"
  std::vector<std::string> command;  ///< program (looked for in PATH without a '/') and arguments
  std::string directory{};           ///< to run in; empty: ours
  std::vector<std::pair<std::string, std::string>> environment{};  ///< added
  int inherited = -1;                                              ///< its descriptor 3
  int stopSignal = 15;                                             ///< SIGTERM; SIGKILL follows it
  bool foreign = false;  ///< may start others that leave its group
  bool operator==(const ChildSpec&) const = default;
};

/// Ended: exit code 0, or stopped by us. Failed: anything else.
enum class ChildState { Running, Ended, Failed };

struct ChildStatus {
  int handle = 0;  ///< stays valid; unique within a supervisor
  ChildSpec spec;
  pid_t pid = 0;
  ChildState state = ChildState::Running;
  std::string detail;      ///< "exit code 2", "killed by signal 9 (Killed)"; empty while running
  std::string lastOutput;  ///< last line that it wrote to stdout or stderr
  bool asked = false;      ///< it ended because it was stopped by us
  bool operator==(const ChildStatus&) const = default;
};

/// A line written by a child, for the log.
struct ChildLine {
  int handle = 0;
  std::string text;  ///< at most 1000 bytes; the rest of a longer line is dropped
};

class ProcessSupervisor {
 public:
  static constexpr std::size_t maxLines = 10'000;
  static constexpr std::size_t maxLineBytes = 1000;

  ProcessSupervisor();
  ProcessSupervisor(const ProcessSupervisor&) = delete;
  ProcessSupervisor& operator=(const ProcessSupervisor&) = delete;
  ~ProcessSupervisor();  ///< stopAll()

  /// The child's handle. Fails when the program cannot be executed (the reason of the system in the
  /// sentence). Returns once the program is running: it waits for fork and exec only.
  Result<int> start(const ChildSpec& spec);
  /// Collects ended children and their output without waiting; call it regularly, because a child
  /// that writes much waits when nobody reads.
  void poll();
  /// All that were ever started, in order.
  const std::vector<ChildStatus>& children() const { return m_children; }
  /// Lines since the last call; the oldest are dropped beyond 10 000, and counted.
  std::vector<ChildLine> takeLines();
  /// How many lines were dropped because nobody took them.
  std::uint64_t droppedLines() const { return m_droppedLines; }

  /// Stands or falls with this process: from now on a guard, run by `program` (pitchboard-robot),
  /// ends all that was started here when this process is killed.
  Result<void> keepGuard(const std::string& program);
  bool isGuarded() const { return static_cast<bool>(m_guard); }
  /// The guard removes a segment that we made, if nobody uses it any more.
  void guardSegment(const Blackboard& board);

  /// It and what it started, as far as that lives; of a foreign program. Looks at all processes.
  std::vector<pid_t> startedBy(int handle) const;

  /// Stops it, or lets it go on, with all that it started.
  void pauseChild(int handle, bool paused);
  void signalChild(int handle, int signal) const;

  /// Its stop signal, then SIGKILL to what is left after the grace period. Returns when all are
  /// gone.
  void stop(RobotId robot, std::chrono::milliseconds grace = std::chrono::milliseconds(500));
  void stopAll(std::chrono::milliseconds grace = std::chrono::milliseconds(500));
  /// The same for one child.
  void stopChild(int handle, std::chrono::milliseconds grace = std::chrono::milliseconds(500));
  /// Drops a child that has ended from children(), for those who start many one after another.
  void forget(int handle);

 private:
  struct Output {         // of a running child
    Descriptor pipe;      // read end of its pipe
    std::string partial;  // the line that has no end yet
    bool asked = false;   // stop() told it to end
  };

  void stopThose(const std::vector<int>& handles, std::chrono::milliseconds grace);
  bool anyRunning(const std::vector<int>& handles) const;
  void signalGroups(const std::vector<int>& handles, int signal) const;
  std::string markOf(int handle) const;
  void killStrays(const ChildStatus& child) const;
  void tellGuard(const std::string& line);
  void readOutput(ChildStatus& child, Output& output, std::size_t limit);
  void endLine(ChildStatus& child, Output& output);
  void collect(ChildStatus& child, Output& output);

  std::vector<ChildStatus> m_children;
  std::map<int, Output> m_outputs;  // by handle, running children only
  std::deque<ChildLine> m_lines;
  std::uint64_t m_droppedLines = 0;
  int m_nextHandle = 1;
  std::string m_run;   // begins the mark of all that is started here
  Descriptor m_guard;  // to the guard; empty: there is none
  pid_t m_guardPid = 0;
};

}  // namespace pitchboard::link
