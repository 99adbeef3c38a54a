// SPDX-License-Identifier: GPL-3.0-or-later
// Loaded before a program: a disk that takes SLOW_DISK_SECONDS to keep what it is given of a
// session.
#include <unistd.h>
#include <cstdlib>
#include <string>
#include <string_view>

extern "C" int fdatasync(int descriptor) {
  char name[4096];
  const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
  const ssize_t length = readlink(link.c_str(), name, sizeof name);
  const std::string_view path(name, length > 0 ? static_cast<std::size_t>(length) : 0);
  const char* seconds = std::getenv("SLOW_DISK_SECONDS");
  if (seconds == nullptr || !path.ends_with(".mcap")) return fsync(descriptor);
  sleep(static_cast<unsigned>(std::atoi(seconds)));
  return 0;
}
