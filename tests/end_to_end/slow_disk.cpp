// SPDX-License-Identifier: GPL-3.0-or-later
// Loaded before a program: a disk that takes SLOW_DISK_SECONDS to keep what it is given.
#include <unistd.h>
#include <cstdlib>

extern "C" int fdatasync(int) {
  const char* seconds = std::getenv("SLOW_DISK_SECONDS");
  sleep(seconds != nullptr ? static_cast<unsigned>(std::atoi(seconds)) : 0U);
  return 0;
}
