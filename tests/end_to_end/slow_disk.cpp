// SPDX-License-Identifier: GPL-3.0-or-later
// Loaded before a program: a disk that takes SLOW_DISK_SECONDS to keep what it is given of a
// session, and that writes to the file SYNCED_FOLDERS which folders it was told to keep, a line for
// each: the folder and the names that stood in it then.
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace {

namespace fs = std::filesystem;

std::string pathOf(int descriptor) {
  std::error_code unknown;
  return fs::read_symlink("/proc/self/fd/" + std::to_string(descriptor), unknown).string();
}

void noteFolder(const std::string& path) {
  const char* const notes = std::getenv("SYNCED_FOLDERS");
  std::error_code problem;
  if (notes == nullptr || !fs::is_directory(path, problem)) return;
  std::string line = path;
  for (const auto& entry : fs::directory_iterator(path, problem)) {
    line += '\t' + entry.path().filename().string();
  }
  line += '\n';
  const int file = open(notes, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  if (file < 0) return;
  if (write(file, line.data(), line.size()) < 0) std::abort();
  close(file);
}

}  // namespace

extern "C" int fdatasync(int descriptor) {
  const char* const seconds = std::getenv("SLOW_DISK_SECONDS");
  if (seconds == nullptr || !pathOf(descriptor).ends_with(".mcap")) {
    return static_cast<int>(syscall(SYS_fdatasync, descriptor));
  }
  sleep(static_cast<unsigned>(std::atoi(seconds)));
  return 0;
}

extern "C" int fsync(int descriptor) {
  noteFolder(pathOf(descriptor));
  return static_cast<int>(syscall(SYS_fsync, descriptor));
}
