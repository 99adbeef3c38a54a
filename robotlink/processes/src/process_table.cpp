// SPDX-License-Identifier: GPL-3.0-or-later
#include "process_table.h"

#include <dirent.h>
#include <linux/futex.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>
#include <charconv>
#include <ctime>
#include <memory>
#include <sstream>

#include <base/read_file.h>

namespace pitchboard::link {
namespace {

constexpr std::size_t mostBytes = 4 * 1024 * 1024;

std::string folderOf(pid_t pid) {
  return "/proc/" + std::to_string(pid);
}

std::uint64_t numberAfter(std::string_view text, std::string_view key) {
  std::uint64_t value = 0;
  const std::size_t at = text.find(key);
  if (at == std::string_view::npos) return value;
  const std::size_t digit = text.find_first_of("0123456789", at + key.size());
  if (digit == std::string_view::npos) return value;
  std::from_chars(text.data() + digit, text.data() + text.size(), value);
  return value;
}

}  // namespace

std::optional<ProcessUse> processUse(pid_t pid) {
  const auto stat = readFile(folderOf(pid) + "/stat", mostBytes);
  const auto status = readFile(folderOf(pid) + "/status", mostBytes);
  if (!stat || !status) return {};
  // The name in brackets may hold anything, so the fields are counted from its end.
  const std::size_t bracket = stat->rfind(')');
  if (bracket == std::string::npos) return {};
  std::istringstream fields(stat->substr(bracket + 1));
  ProcessUse use;
  std::string skipped;
  double user = 0.0, system = 0.0;
  fields >> use.state;
  for (int i = 0; i < 10; ++i) fields >> skipped;
  fields >> user >> system;
  use.cpuSeconds = (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
  use.readySeconds = use.cpuSeconds;
  if (const auto schedule = readFile(folderOf(pid) + "/schedstat", mostBytes)) {
    constexpr double nanoseconds = 1e9;
    std::istringstream times(*schedule);
    double worked = 0.0, waited = 0.0;
    if (times >> worked >> waited) use.readySeconds = (worked + waited) / nanoseconds;
  }
  use.memoryBytes = numberAfter(*status, "VmRSS:") * 1024;
  use.sleeps = numberAfter(*status, "\nvoluntary_ctxt_switches:");
  return use;
}

namespace {

/// Its thread waits for a futex until a moment of the monotonic clock that is years away.
bool waitsForEver(pid_t pid, const std::string& threadFolder) {
  constexpr std::int64_t year = 365 * 24 * 3600;
  const auto call = readFile(threadFolder + "/syscall", mostBytes);
  if (!call) return false;
  std::istringstream fields(*call);
  long number = -1;
  std::uint64_t address = 0, operation = 0, value = 0, limit = 0;
  if (!(fields >> number >> std::hex >> address >> operation >> value >> limit)) return false;
  const bool waits = number == SYS_futex && (operation & FUTEX_CMD_MASK) == FUTEX_WAIT_BITSET &&
                     (operation & FUTEX_CLOCK_REALTIME) == 0 && limit != 0;
  if (!waits) return false;
  timespec until{}, now{};
  iovec here{&until, sizeof until};
  iovec there{reinterpret_cast<void*>(limit), sizeof until};  // NOLINT: an address of the other one
  if (::process_vm_readv(pid, &here, 1, &there, 1, 0) != sizeof until) return false;
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return until.tv_sec - now.tv_sec > year;
}

}  // namespace

ThreadWaits threadWaits(pid_t pid) {
  ThreadWaits all;
  const std::string tasks = folderOf(pid) + "/task";
  const std::unique_ptr<DIR, int (*)(DIR*)> folder(::opendir(tasks.c_str()), &::closedir);
  if (!folder) return all;
  while (const dirent* entry = ::readdir(folder.get())) {
    if (entry->d_name[0] == '.') continue;
    const std::string thread = tasks + '/' + entry->d_name;
    if (const auto status = readFile(thread + "/status", mostBytes)) {
      all.sleeps += numberAfter(*status, "\nvoluntary_ctxt_switches:");
    }
    all.forEver = all.forEver || waitsForEver(pid, thread);
  }
  return all;
}

bool mapsSegment(pid_t pid, int shmid) {
  const auto maps = readFile(folderOf(pid) + "/maps", mostBytes);
  if (!maps) {
    const auto use = processUse(pid);
    return use && use->state != 'Z';
  }
  std::istringstream lines(*maps);
  // addresses, rights, offset, device, the segment's number, /SYSV and its key
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    std::string skipped, path;
    long long inode = 0;
    fields >> skipped >> skipped >> skipped >> skipped >> inode >> path;
    if (inode == shmid && path.starts_with("/SYSV")) return true;
  }
  return false;
}

std::vector<pid_t> markedProcesses(std::string_view mark) {
  std::vector<pid_t> found;
  const std::unique_ptr<DIR, int (*)(DIR*)> folder(::opendir("/proc"), &::closedir);
  if (!folder) return found;
  const std::string wanted = std::string(processMark) + '=' + std::string(mark);
  while (const dirent* entry = ::readdir(folder.get())) {
    const std::string_view name(entry->d_name);
    pid_t pid = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), pid);
    if (error != std::errc{} || end != name.data() + name.size() || pid == ::getpid()) continue;
    const auto environment = readFile(folderOf(pid) + "/environ", mostBytes);
    if (!environment) continue;
    const std::size_t at = environment->find(wanted);
    if (at == std::string::npos || (at > 0 && (*environment)[at - 1] != '\0')) continue;
    const auto use = processUse(pid);
    if (use && use->state != 'Z' && use->state != 'X') found.push_back(pid);
  }
  return found;
}

}  // namespace pitchboard::link
