// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/byte_sizes.h>
#include <robotlink/processes/child_process.h>

#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string_view>

#include <base/try.h>
#include <robotlink/processes/keeper.h>

#include "process_table.h"

namespace pitchboard::link {
namespace {

// A full pipe (spawn.cpp), and what is written meanwhile. A child that floods must not hold poll()
// up.
constexpr std::size_t bytesPerPoll = 2 * mebibyte;

// Never in the middle of a UTF-8 character.
std::string_view cut(std::string_view text, std::size_t limit) {
  if (text.size() <= limit) return text;
  std::size_t end = limit;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return text.substr(0, end == 0 ? limit : end);
}

std::string describe(const siginfo_t& end) {
  if (end.si_code == CLD_EXITED) return "exit code " + std::to_string(end.si_status);
  std::string text = "killed by signal " + std::to_string(end.si_status);
  if (const char* name = ::sigdescr_np(end.si_status)) text += std::string(" (") + name + ")";
  return text;
}

}  // namespace

ChildProcess::ChildProcess(Spawned child, UniqueFd keeper, pid_t pid)
    : m_child(std::move(child)),
      m_ended(static_cast<int>(::syscall(SYS_pidfd_open, m_child.pid, 0))),
      m_keeper(std::move(keeper)),
      m_pid(pid) {}

Result<ChildProcess> ChildProcess::start(const ChildSpec& spec, const std::string& robotProgram) {
  SpawnRequest request{spec.command, spec.directory, spec.environment};
  request.inherited = spec.inherited;
  if (!spec.isTeamProgram) {
    Spawned child = TRY(spawn(request));
    const pid_t pid = child.pid;
    return ChildProcess(std::move(child), {}, pid);
  }
  Kept kept = TRY(spawnKept(request, robotProgram));
  return ChildProcess(std::move(kept.keeper), std::move(kept.control), kept.program);
}

std::vector<pid_t> ChildProcess::all() const {
  std::vector<pid_t> all = descendantsOf(m_child.pid);
  if (!m_keeper) all.push_back(m_pid);
  return all;
}

void ChildProcess::signal(int number) const {
  if (m_keeper) {
    // A keeper that is gone is no reason to end: MSG_NOSIGNAL instead of SIGPIPE.
    const char word = static_cast<char>(number);
    (void)::send(m_keeper.get(), &word, 1, MSG_NOSIGNAL);
  } else {
    ::kill(-m_pid, number);  // not yet collected, so its number cannot belong to anybody else
  }
}

std::optional<ChildProcess::End> ChildProcess::poll(std::vector<std::string>& lines) {
  readOutput(lines, bytesPerPoll);
  siginfo_t end{};
  // WNOWAIT keeps the process as a zombie, and with it its number, so that the signal below can
  // only reach its own group.
  const int waited =
      ::waitid(P_PID, static_cast<id_t>(m_child.pid), &end, WEXITED | WNOHANG | WNOWAIT);
  const bool unknown = waited != 0 && errno == ECHILD;
  if (!unknown && (waited != 0 || end.si_pid == 0)) return {};
  if (!unknown) {
    ::kill(-m_child.pid, SIGKILL);
    while (::waitpid(m_child.pid, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  readOutput(lines, bytesPerPoll);
  if (!m_partial.empty()) endLine(lines);
  if (unknown) return End{"ended for an unknown reason", true};
  return End{describe(end), end.si_code != CLD_EXITED || end.si_status != 0};
}

bool ChildProcess::addTo(int epoll, std::uint64_t id) const {
  // Edge-triggered, because the end of a pipe that stays open need not be read.
  epoll_event news{};
  news.events = EPOLLIN | EPOLLET;
  news.data.u64 = id;
  return ::epoll_ctl(epoll, EPOLL_CTL_ADD, m_child.output.get(), &news) == 0 &&
         ::epoll_ctl(epoll, EPOLL_CTL_ADD, m_ended.get(), &news) == 0;
}

void ChildProcess::readOutput(std::vector<std::string>& lines, std::size_t limit) {
  char buffer[16 * 1024];
  for (std::size_t total = 0; total < limit;) {
    const ssize_t got = ::read(m_child.output.get(), buffer, sizeof buffer);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return;  // nothing to read now, or the writer has closed the pipe
    total += static_cast<std::size_t>(got);
    std::string_view rest(buffer, static_cast<std::size_t>(got));
    while (!rest.empty()) {
      const std::size_t newline = rest.find('\n');
      const std::string_view piece = rest.substr(0, newline);
      // A few bytes more than are kept, so that endLine() can cut between characters.
      m_partial += piece.substr(0, maxLineBytes + 4 - std::min(maxLineBytes + 4, m_partial.size()));
      if (newline == std::string_view::npos) break;
      endLine(lines);
      rest.remove_prefix(newline + 1);
    }
  }
}

void ChildProcess::endLine(std::vector<std::string>& lines) {
  if (m_partial.ends_with('\r')) m_partial.pop_back();
  lines.emplace_back(cut(m_partial, maxLineBytes));
  m_partial.clear();
}

}  // namespace pitchboard::link
