// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Keys of this test process alone, so that tests may run beside each other and beside robots
// (matches have keys below 500 000).

#include <sys/ipc.h>
#include <sys/shm.h>
#include <unistd.h>

inline int testKeyBase() {
  return static_cast<int>((1000000LL + getpid() * 7000LL % 900000000LL) / 100 * 100);
}

inline void removeSegment(int key) {
  const int shmid = shmget(key, 0, 0);
  if (shmid >= 0) shmctl(shmid, IPC_RMID, nullptr);
}
