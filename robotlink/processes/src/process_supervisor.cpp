// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/processes/process_supervisor.h>

#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string_view>
#include <thread>

#include <robotlink/processes/spawn.h>

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

ProcessSupervisor::~ProcessSupervisor() {
  stopAll();
}

Result<int> ProcessSupervisor::start(const ChildSpec& spec) {
  Result<Spawned> child = spawn(spec.command);
  if (!child) return tl::unexpected<Error>(child.error());
  const int handle = m_nextHandle++;
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

void ProcessSupervisor::signalGroups(const std::vector<int>& handles, int signal) const {
  for (const ChildStatus& child : m_children) {
    // Not yet collected, so its number cannot belong to anybody else.
    if (m_outputs.contains(child.handle) &&
        std::find(handles.begin(), handles.end(), child.handle) != handles.end()) {
      ::kill(-child.pid, signal);
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
  signalGroups(handles, SIGTERM);
  waitUntil(std::chrono::steady_clock::now() + grace);
  signalGroups(handles, SIGKILL);
  waitUntil(std::chrono::steady_clock::now() + killPatience);
}

}  // namespace pitchboard::link
