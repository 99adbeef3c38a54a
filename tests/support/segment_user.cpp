// SPDX-License-Identifier: GPL-3.0-or-later
// Another program that uses a blackboard, for tests: segment_user DEED KEY. What has to fork does
// it here: a test is a program with threads.
//   hold    attaches or creates, says "y", stays until it is killed
//   claim   takes the claim of a bridge, says "y" or "n", stays until it is killed
//   leave   creates a segment and ends: an orphan
//   write   writes through a read-only attachment, which must not end well
//   count   attaches or creates, says "y", writes as fast as it can until it is killed: int 0
//   counts on from what
//           stands there, int 1 has four equal bytes, and so have the lower three of float 0
//   fork    attaches, lets a forked child destroy its copy, says whether the segment is still there
#include <sys/ipc.h>
#include <sys/shm.h>
#include <sys/wait.h>
#include <unistd.h>

#include <bit>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include <robotlink/blackboard/system_v.h>

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

int printAndWait(bool good) {
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

[[noreturn]] void count(int key) {
  auto board = SystemVSegments::open(key, AttachMode::AttachOrCreate);
  std::puts(board ? "y" : "n");
  std::fflush(stdout);
  if (!board) std::exit(1);
  for (std::uint32_t n = static_cast<std::uint32_t>(board->read(IntVar{0}));; ++n) {
    const std::uint32_t byte = n & 0xffU;
    board->write(IntVar{0}, static_cast<int>(n));
    board->write(IntVar{1}, std::bit_cast<int>(byte * 0x01010101U));
    board->write(FloatVar{0}, std::bit_cast<float>(0x3f000000U | byte * 0x00010101U));
  }
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
  const std::string_view action = argv[1];
  const int key = std::atoi(argv[2]);
  if (action == "hold") {
    const auto board = SystemVSegments::open(key, AttachMode::AttachOrCreate);
    return printAndWait(board.has_value());
  }
  if (action == "claim") {
    const auto claim = BridgeClaim::take(key);
    return printAndWait(claim.has_value());
  }
  if (action == "leave") return shmget(key, 2048, IPC_CREAT | IPC_EXCL | 0600) < 0 ? 1 : 0;
  if (action == "write") return writeReadOnly(key);
  if (action == "count") count(key);
  if (action == "fork") return forkAndDestroy(key);
  return 2;
}
