// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One running child process. It never outlives this process, however that ends: our programs get a
// parent-death signal, a team's program has a keeper (see keeper.h). Use it from the thread that
// started it, which must live as long as the child: the kernel sends the signal when that THREAD
// ends.
//
// Every child leads a process group of its own, reads /dev/null, and has its standard output and
// error collected line by line. When it ends, what it started itself ends with it: the rest of its
// group is killed, and of a team's program also what left the group.

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
  std::string name;                  ///< for people: "decision"
  std::vector<std::string> command;  ///< program (looked for in PATH without a '/') and arguments
  std::string directory{};           ///< to run in; empty: ours
  std::vector<std::pair<std::string, std::string>> environment{};  ///< added
  int inherited = -1;                                              ///< its descriptor 3
  int stopSignal = 15;                                             ///< SIGTERM; SIGKILL follows it
  bool foreign = false;  ///< a team's program: may start others that leave its group
  bool operator==(const ChildSpec&) const = default;
};

class ChildProcess {
 public:
  static constexpr std::size_t maxLineBytes = 1000;

  struct End {
    std::string detail;  ///< "exit code 2", "killed by signal 9 (Killed)"
    bool failed = false;
  };

  /// Fails when the program cannot be executed (the reason of the system in the sentence). Returns
  /// once the program is running. `robotProgram` (pitchboard-robot) keeps a team's program.
  static Result<ChildProcess> start(const ChildSpec& spec, const std::string& robotProgram);

  pid_t pid() const { return m_pid; }
  /// It and what it started, as far as that lives.
  std::vector<pid_t> all() const;
  /// To its process group; SIGSTOP, SIGCONT and SIGKILL also to what left the group.
  void signal(int number) const;
  /// Collects its output and its end without waiting; call it regularly, because a child that
  /// writes much waits when nobody reads. Lines have at most maxLineBytes; the rest of a longer one
  /// is dropped. Once it has ended, the object is of no use any more.
  std::optional<End> poll(std::vector<std::string>& lines);
  /// Tells this set (epoll) when it has written something and when it has ended, each time once,
  /// with `id`. False where the system cannot: then poll() it regularly.
  bool tell(int epoll, std::uint64_t id) const;

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
