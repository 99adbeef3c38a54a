// SPDX-License-Identifier: GPL-3.0-or-later
#include "process_table.h"

#include <sys/stat.h>
#include <unistd.h>
#include <charconv>
#include <filesystem>
#include <sstream>
#include <system_error>

#include <base/byte_sizes.h>
#include <base/read_file.h>

namespace pitchboard::link {
namespace {

constexpr std::size_t maxBytes = 4 * mebibyte;

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
  const auto stat = readFile(folderOf(pid) + "/stat", maxBytes);
  if (!stat) return {};
  // The name in brackets may hold anything, so the fields are counted from its end.
  const std::size_t bracket = stat->rfind(')');
  if (bracket == std::string::npos) return {};
  std::istringstream fields(stat->substr(bracket + 1));
  ProcessUse use;
  std::string skipped;
  double user = 0.0, system = 0.0;
  std::uint64_t pages = 0;
  fields >> use.state;
  for (int i = 0; i < 10; ++i) fields >> skipped;
  fields >> user >> system;
  for (int i = 0; i < 8; ++i) fields >> skipped;
  fields >> pages;
  use.cpuSeconds = (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
  use.memoryBytes = pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  return use;
}

std::optional<ProcessRhythm> processRhythm(pid_t pid) {
  const auto status = readFile(folderOf(pid) + "/status", maxBytes);
  const auto schedule = readFile(folderOf(pid) + "/schedstat", maxBytes);
  if (!status) return {};
  constexpr double nanoseconds = 1e9;
  ProcessRhythm rhythm;
  rhythm.sleeps = numberAfter(*status, "\nvoluntary_ctxt_switches:");
  std::istringstream times(schedule.value_or(std::string()));
  double worked = 0.0, waited = 0.0;
  if (times >> worked >> waited) rhythm.readySeconds = (worked + waited) / nanoseconds;
  return rhythm;
}

namespace {

/// Whether a line of its map, with the inode and the path in it, is what `isIt` looks for. True
/// where the system does not let us look.
template <class IsIt>
bool maps(pid_t pid, IsIt isIt) {
  const auto text = readFile(folderOf(pid) + "/maps", maxBytes);
  if (!text) {
    const auto use = processUse(pid);
    return use && use->state != 'Z';
  }
  std::istringstream lines(*text);
  // addresses, rights, offset, device, inode, path
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    std::string skipped, path;
    long long inode = 0;
    fields >> skipped >> skipped >> skipped >> skipped >> inode >> path;
    if (isIt(inode, path)) return true;
  }
  return false;
}

}  // namespace

bool mapsSegment(pid_t pid, int shmid) {
  return maps(pid, [shmid](long long inode, const std::string& path) {
    return inode == shmid && path.starts_with("/SYSV");
  });
}

bool mapsFile(pid_t pid, std::string_view name) {
  return maps(pid, [name](long long, const std::string& path) { return path.ends_with(name); });
}

std::vector<pid_t> descendantsOf(pid_t pid) {
  std::vector<pid_t> found{pid};
  for (std::size_t at = 0; at < found.size(); ++at) {
    std::error_code error;
    for (const auto& thread :
         std::filesystem::directory_iterator(folderOf(found[at]) + "/task", error)) {
      std::istringstream children(
          readFile(thread.path().string() + "/children", maxBytes).value_or(std::string()));
      for (pid_t child = 0; children >> child;) found.push_back(child);
    }
  }
  found.erase(found.begin());
  return found;
}

std::string programStamp(const ChildSpec& spec) {
  std::string stamp;
  for (const std::string& argument : spec.command) {
    const bool fromHere = !spec.directory.empty() && !argument.starts_with('/');
    struct stat file {};
    if (::stat((fromHere ? spec.directory + '/' + argument : argument).c_str(), &file) != 0)
      continue;
    if (!S_ISREG(file.st_mode)) continue;
    for (const long long part :
         {static_cast<long long>(file.st_ino), static_cast<long long>(file.st_size),
          static_cast<long long>(file.st_mtim.tv_sec),
          static_cast<long long>(file.st_mtim.tv_nsec)}) {
      stamp += std::to_string(part) + ' ';
    }
  }
  return stamp;
}

}  // namespace pitchboard::link
