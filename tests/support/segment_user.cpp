// SPDX-License-Identifier: GPL-3.0-or-later
// Another program that uses a blackboard, for tests: segment_user DEED KEY. What has to fork does
// it here: a test is a program with threads.
//   hold    attaches or creates, says "y", stays until it is killed
//   claim   takes the claim of a bridge, says "y" or "n", stays until it is killed
//   leave   creates a segment and ends: an orphan
//   write   writes through a read-only attachment, which must not end well
//   fork    attaches, lets a forked child destroy its copy, says whether the segment is still there
#include <sys/ipc.h>
#include <sys/shm.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include <robotlink/blackboard/system_v.h>

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

int sayAndStay(bool good) {
  std::puts(good ? "y" : "n");
  std::fflush(stdout);
  for (;;) pause();
}

int forkAndDestroy(int key) {
  auto board = SystemVSegments::open(key, AttachMode::AttachOrCreate);
  const pid_t child = fork();
  if (child == 0) {
    board = failure(ErrorCode::NotFound, "");  // destroys the child's copy
    _exit(0);
  }
  waitpid(child, nullptr, 0);
  std::puts(SystemVSegments::info(key) ? "y" : "n");
  return 0;
}

int writeReadOnly(int key) {
  std::signal(SIGSEGV, SIG_DFL);
  auto board = SystemVSegments::open(key, AttachMode::ReadOnly);
  if (board) board->write(IntVar{0}, 1);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::string_view deed = argv[1];
  const int key = std::atoi(argv[2]);
  if (deed == "hold") {
    const auto board = SystemVSegments::open(key, AttachMode::AttachOrCreate);
    return sayAndStay(board.has_value());
  }
  if (deed == "claim") {
    const auto claim = BridgeClaim::take(key);
    return sayAndStay(claim.has_value());
  }
  if (deed == "leave") return shmget(key, 2048, IPC_CREAT | IPC_EXCL | 0600) < 0 ? 1 : 0;
  if (deed == "write") return writeReadOnly(key);
  if (deed == "fork") return forkAndDestroy(key);
  return 2;
}
