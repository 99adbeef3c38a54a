// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/processes/process_supervisor.h>

#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string_view>
#include <thread>

#include <base/system_reason.h>
#include <robotlink/blackboard/system_v.h>
#include <robotlink/processes/guard.h>
#include <robotlink/processes/spawn.h>

#include "process_table.h"

namespace pitchboard::link {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t bytesPerPoll = 256 * 1024;  // a child that floods must not hold poll() up
constexpr std::size_t bytesAtEnd = 1024 * 1024;   // a full pipe holds less
constexpr auto killPatience = 5s;                 // longer than this only in a stuck system call

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
  if (const char* words = ::sigdescr_np(end.si_status)) text += std::string(" (") + words + ")";
  return text;
}

}  // namespace

ProcessSupervisor::ProcessSupervisor() {
  static std::atomic<unsigned> made{0};
  const auto now = std::chrono::system_clock::now().time_since_epoch().count();
  m_run =
      std::to_string(::getpid()) + '.' + std::to_string(now) + '.' + std::to_string(++made) + ':';
}

ProcessSupervisor::~ProcessSupervisor() {
  stopAll();
  if (!m_guard) return;
  tellGuard(guardWords::done);
  // It ends at once; only one that was stopped would keep us.
  const auto end = std::chrono::steady_clock::now() + killPatience;
  while (::waitpid(m_guardPid, nullptr, WNOHANG) == 0 && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(1ms);
  }
}

std::string ProcessSupervisor::markOf(int handle) const {
  return m_run + std::to_string(handle) + ':';
}

Result<void> ProcessSupervisor::keepGuard(const std::string& program) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    return failure(ErrorCode::SystemError,
                   "the robots' processes cannot be guarded: " + systemReason(errno));
  }
  Descriptor ours(ends[0]);
  const Descriptor its(ends[1]);
  SpawnRequest request{{program, std::string(guardCommand), m_run}};
  request.input = its.get();
  request.outlives = true;
  request.environment = {{processMark, ""}};  // nobody's: who supervises us must not end it
  const auto started = spawn(request);
  if (!started) return tl::unexpected(started.error());
  m_guardPid = started->pid;
  m_guard = std::move(ours);
  return {};
}

void ProcessSupervisor::guardSegment(const Blackboard& board) {
  if (!m_guard || !board.created()) return;
  if (const auto info = SystemVSegments::info(board.key())) {
    tellGuard(guardWords::segment(info->key, info->shmid));
  }
}

void ProcessSupervisor::tellGuard(const std::string& line) {
  // A guard that is gone is no reason to end: MSG_NOSIGNAL instead of SIGPIPE.
  if (m_guard) (void)::send(m_guard.get(), line.data(), line.size(), MSG_NOSIGNAL);
}

Result<int> ProcessSupervisor::start(const ChildSpec& spec) {
  const int handle = m_nextHandle++;
  SpawnRequest request{spec.command, spec.directory, spec.environment};
  request.environment.emplace_back(processMark, markOf(handle));
  request.inherited = spec.inherited;
  Result<Spawned> child = spawn(request);
  if (!child) return tl::unexpected<Error>(child.error());
  m_children.push_back({handle, spec, child->pid, ChildState::Running, {}, {}});
  m_outputs[handle].pipe = std::move(child->output);
  return handle;
}

void ProcessSupervisor::poll() {
  for (ChildStatus& child : m_children) {
    const auto output = m_outputs.find(child.handle);
    if (output == m_outputs.end()) continue;
    readOutput(child, output->second, bytesPerPoll);
    collect(child, output->second);
    if (child.state != ChildState::Running) m_outputs.erase(output);
  }
}

void ProcessSupervisor::collect(ChildStatus& child, Output& output) {
  siginfo_t end{};
  const auto id = static_cast<id_t>(child.pid);
  // WNOWAIT keeps the process as a zombie, and with it its number, so that the signal below can
  // only reach its own group.
  const int waited = ::waitid(P_PID, id, &end, WEXITED | WNOHANG | WNOWAIT);
  const bool unknown = waited != 0 && errno == ECHILD;
  if (!unknown && (waited != 0 || end.si_pid == 0)) return;

  if (!unknown) {
    ::kill(-child.pid, SIGKILL);
    killStrays(child);
    while (::waitpid(child.pid, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  readOutput(child, output, bytesAtEnd);
  if (!output.partial.empty()) endLine(child, output);
  output.pipe.reset();
  child.detail = unknown ? "ended, and the system did not say how" : describe(end);
  child.asked = output.asked;
  const bool wellEnded = !unknown && end.si_code == CLD_EXITED && end.si_status == 0;
  child.state = wellEnded || output.asked ? ChildState::Ended : ChildState::Failed;
}

void ProcessSupervisor::readOutput(ChildStatus& child, Output& output, std::size_t limit) {
  char buffer[16 * 1024];
  for (std::size_t total = 0; total < limit;) {
    const ssize_t got = ::read(output.pipe.get(), buffer, sizeof buffer);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return;  // nothing now, or nobody writes any more
    total += static_cast<std::size_t>(got);
    std::string_view rest(buffer, static_cast<std::size_t>(got));
    while (!rest.empty()) {
      const std::size_t newline = rest.find('\n');
      const std::string_view piece = rest.substr(0, newline);
      // A few bytes more than are kept, so that endLine() can cut between characters.
      const std::size_t room = maxLineBytes + 4 - std::min(maxLineBytes + 4, output.partial.size());
      output.partial += piece.substr(0, room);
      if (newline == std::string_view::npos) break;
      endLine(child, output);
      rest.remove_prefix(newline + 1);
    }
  }
}

void ProcessSupervisor::endLine(ChildStatus& child, Output& output) {
  if (output.partial.ends_with('\r')) output.partial.pop_back();
  child.lastOutput = cut(output.partial, maxLineBytes);
  output.partial.clear();
  m_lines.push_back({child.handle, child.lastOutput});
  if (m_lines.size() > maxLines) {
    m_lines.pop_front();
    ++m_droppedLines;
  }
}

std::vector<ChildLine> ProcessSupervisor::takeLines() {
  std::vector<ChildLine> lines(std::make_move_iterator(m_lines.begin()),
                               std::make_move_iterator(m_lines.end()));
  m_lines.clear();
  return lines;
}

void ProcessSupervisor::stop(RobotId robot, std::chrono::milliseconds grace) {
  std::vector<int> handles;
  for (const ChildStatus& child : m_children) {
    if (child.spec.robot == robot) handles.push_back(child.handle);
  }
  stopThose(handles, grace);
}

void ProcessSupervisor::stopAll(std::chrono::milliseconds grace) {
  std::vector<int> handles;
  for (const ChildStatus& child : m_children) handles.push_back(child.handle);
  stopThose(handles, grace);
}

void ProcessSupervisor::stopChild(int handle, std::chrono::milliseconds grace) {
  stopThose({handle}, grace);
}

void ProcessSupervisor::forget(int handle) {
  std::erase_if(m_children, [this, handle](const ChildStatus& child) {
    return child.handle == handle && !m_outputs.contains(handle);
  });
}

bool ProcessSupervisor::anyRunning(const std::vector<int>& handles) const {
  return std::any_of(handles.begin(), handles.end(),
                     [this](int handle) { return m_outputs.contains(handle); });
}

void ProcessSupervisor::signalChild(int handle, int signal) const {
  signalGroups({handle}, signal);
}

std::vector<pid_t> ProcessSupervisor::startedBy(int handle) const {
  return markedProcesses(markOf(handle));
}

void ProcessSupervisor::pauseChild(int handle, bool paused) {
  const int signal = paused ? SIGSTOP : SIGCONT;
  for (const ChildStatus& child : m_children) {
    if (child.handle != handle || !m_outputs.contains(handle)) continue;
    ::kill(-child.pid, signal);
    if (!child.spec.foreign) continue;
    for (const pid_t pid : startedBy(handle)) ::kill(pid, signal);
  }
}

void ProcessSupervisor::killStrays(const ChildStatus& child) const {
  if (!child.spec.foreign) return;
  // What is killed may just have started another one.
  for (int round = 0; round < 8; ++round) {
    bool any = false;
    for (const pid_t pid : startedBy(child.handle)) {
      if (pid != child.pid) any = ::kill(pid, SIGKILL) == 0 || any;
    }
    if (!any) return;
  }
}

void ProcessSupervisor::signalGroups(const std::vector<int>& handles, int signal) const {
  for (const ChildStatus& child : m_children) {
    // Not yet collected, so its number cannot belong to anybody else.
    if (m_outputs.contains(child.handle) &&
        std::find(handles.begin(), handles.end(), child.handle) != handles.end()) {
      ::kill(-child.pid, signal == 0 ? child.spec.stopSignal : signal);
      // One that is stopped would never learn of it.
      if (signal == 0) ::kill(-child.pid, SIGCONT);
    }
  }
}

void ProcessSupervisor::stopThose(const std::vector<int>& handles,
                                  std::chrono::milliseconds grace) {
  poll();
  for (const int handle : handles) {
    if (const auto output = m_outputs.find(handle); output != m_outputs.end()) {
      output->second.asked = true;
    }
  }
  const auto waitUntil = [this, &handles](std::chrono::steady_clock::time_point end) {
    while (anyRunning(handles) && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(1ms);
      poll();
    }
  };
  constexpr int eachItsOwn = 0;
  signalGroups(handles, eachItsOwn);
  waitUntil(std::chrono::steady_clock::now() + grace);
  signalGroups(handles, SIGKILL);
  waitUntil(std::chrono::steady_clock::now() + killPatience);
}

}  // namespace pitchboard::link
