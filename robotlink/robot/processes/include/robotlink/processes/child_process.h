// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A running child process. It never outlives this process, however that ends: our programs get a
// parent-death signal, and team programs have a keeper (keeper.h). Use it from the thread that
// started it, which must live as long as the child, because the kernel sends the signal when that
// THREAD ends.
//
// Every child leads a process group of its own and reads /dev/null; its standard output and error
// are collected line by line. When it ends, everything that it started ends, too: the rest of its
// group is killed, and for a team program also what left the group.

#include <sys/types.h>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <base/ids.h>
#include <base/result.h>
#include <base/unique_fd.h>
#include <robotlink/processes/spawn.h>

namespace pitchboard::link {

struct ChildSpec {
  RobotId robot;
  std::string name;                  ///< a name for people: "decision"
  std::vector<std::string> command;  ///< program (searched in PATH if it has no '/') and arguments
  std::string directory{};           ///< working directory; empty: ours
  std::vector<std::pair<std::string, std::string>> environment{};  ///< additional variables
  int inherited = -1;                                              ///< becomes its descriptor 3
  int stopSignal = 15;                                             ///< SIGTERM; SIGKILL follows
  bool isTeamProgram = false;  ///< a team program, which may start others that leave its group
  bool operator==(const ChildSpec&) const = default;
};

class ChildProcess {
 public:
  static constexpr std::size_t maxLineBytes = 1000;

  struct End {
    std::string detail;  ///< "exit code 2", "killed by signal 9 (Killed)"
    bool failed = false;
  };

  /// Starts a program and returns when it runs. Fails with the system's reason if it cannot be
  /// executed. `robotProgram` (pitchboard-robot) runs the keeper of a team program.
  static Result<ChildProcess> start(const ChildSpec& spec, const std::string& robotProgram);

  pid_t pid() const { return m_pid; }
  /// Returns the processes of this child that are alive: itself, and what it started.
  std::vector<pid_t> all() const;
  /// Sends a signal to its process group; SIGSTOP, SIGCONT and SIGKILL also to what left the group.
  void signal(int number) const;
  /// Collects output and notices its end, without waiting. Call it regularly, because a child that
  /// writes much blocks if nobody reads. Lines are cut at maxLineBytes. After the end, the object
  /// cannot be used any more.
  std::optional<End> poll(std::vector<std::string>& lines);
  /// Adds its output and its end to this epoll set, edge-triggered: each event is reported once,
  /// with `id`. Returns false if the system cannot do it; then call poll() regularly.
  bool addTo(int epoll, std::uint64_t id) const;

 private:
  ChildProcess(Spawned child, UniqueFd keeper, pid_t pid);
  void readOutput(std::vector<std::string>& lines, std::size_t limit);
  void endLine(std::vector<std::string>& lines);

  Spawned m_child;    // the keeper of a team's program
  UniqueFd m_ended;   // readable once that has ended
  UniqueFd m_keeper;  // to it; empty: there is none
  pid_t m_pid = 0;
  std::string m_partial;  // the line that has no end yet
};

}  // namespace pitchboard::link
