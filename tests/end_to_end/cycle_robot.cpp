// SPDX-License-Identifier: GPL-3.0-or-later
// Walks and turns in lock-step with the match: cycle_robot KEY
#include <sys/shm.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <thread>

int main(int, char** argv) {
  auto* const ints = static_cast<int*>(shmat(shmget(std::atoi(argv[1]), 2048, 0600), nullptr, 0));
  const std::atomic_ref<int> actionA(ints[17]), actionB(ints[18]), cycle(ints[447]);
  cycle = -1;  // I am here
  while (true) {
    while (cycle <= 0) std::this_thread::sleep_for(std::chrono::microseconds(200));
    const int tick = cycle;  // what the robot senses after this tick is there
    actionB = 10;
    actionA = tick % 120 < 60 ? 8 : 2;  // walks a second, turns a second
    cycle = -tick;                      // finished: the match goes on
  }
}
