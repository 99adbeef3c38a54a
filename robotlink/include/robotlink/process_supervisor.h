// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Starts child processes, notices when one ends, ends them all. A child never outlives this
// process, however that ends (parent-death signal). Use from one thread, which must live as long as
// the children: the kernel sends the signal when the starting THREAD ends.

#include <chrono>
#include <map>
#include <string>
#include <sys/types.h>
#include <vector>

#include <base/ids.h>
#include <base/result.h>

namespace pitchboard::link {

struct ChildSpec {
  RobotId robot;
  std::string name;                    ///< for people: "decision"
  std::vector<std::string> command;    ///< program and arguments
};

enum class ChildState { Running, Ended, Failed };

struct ChildStatus {
  int handle = 0;                      ///< stays valid; unique within a supervisor
  ChildSpec spec;
  pid_t pid = 0;
  ChildState state = ChildState::Running;
  std::string detail;                  ///< "exit code 2", "killed by signal 9"; empty while running
  std::string lastOutput;              ///< last line that it wrote to stdout or stderr
  bool operator==(const ChildStatus&) const;
};

/// A line written by a child, for the log.
struct ChildLine {
  int handle = 0;
  std::string text;                    ///< at most 1000 characters
};

class ProcessSupervisor {
 public:
  ProcessSupervisor();
  ProcessSupervisor(const ProcessSupervisor&) = delete;
  ProcessSupervisor& operator=(const ProcessSupervisor&) = delete;
  ~ProcessSupervisor();                ///< stopAll()

  /// Fails when the program cannot be executed (the reason of the system in the sentence).
  Result<int> start(const ChildSpec& spec);
  /// Collects ended children and their output without waiting; call it regularly.
  void poll();
  const std::vector<ChildStatus>& children() const { return m_children; }
  /// Lines since the last call; the oldest are dropped beyond 10 000, and counted.
  std::vector<ChildLine> takeLines();

  /// SIGTERM, then SIGKILL to what is left after the grace period. Returns when all are gone.
  void stop(RobotId robot, std::chrono::milliseconds grace = std::chrono::milliseconds(500));
  void stopAll(std::chrono::milliseconds grace = std::chrono::milliseconds(500));

 private:
  struct Pipe;
  void stopThose(std::vector<int> handles, std::chrono::milliseconds grace);
  std::vector<ChildStatus> m_children;
  std::map<int, int> m_outputs;        // handle -> read end of its pipe
  std::map<int, std::string> m_partial;
  std::vector<ChildLine> m_lines;
  int m_nextHandle = 1;
};

}  // namespace pitchboard::link
