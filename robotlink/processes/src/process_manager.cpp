// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/processes/process_manager.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <fstream>

namespace pitchboard::link {
namespace {

using Seconds = ManagerTiming::Seconds;
using Ticks = std::chrono::steady_clock::duration;

Ticks ticks(Seconds seconds) {
  return std::chrono::duration_cast<Ticks>(seconds);
}

std::string inSeconds(Seconds seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g s", seconds.count());
  return text;
}

/// How often the process has gone to sleep by itself: a periodic one does in every cycle.
std::uint64_t sleepsOf(pid_t pid) {
  std::ifstream status("/proc/" + std::to_string(pid) + "/status");
  constexpr std::string_view key = "voluntary_ctxt_switches:";
  for (std::string line; std::getline(status, line);) {
    if (!line.starts_with(key)) continue;
    const std::size_t digit = line.find_first_of("0123456789", key.size());
    std::uint64_t count = 0;
    if (digit != std::string::npos) {
      std::from_chars(line.data() + digit, line.data() + line.size(), count);
    }
    return count;
  }
  return 0;
}

}  // namespace

ProcessManager::ProcessManager(RobotId robot, std::vector<ManagedProcess> processes,
                               const ManagerTiming& timing, Blackboard& board, bool clearFlags)
    : m_robot(robot), m_timing(timing), m_board(board), m_clearFlags(clearFlags) {
  for (ManagedProcess& process : processes) {
    Entry entry;
    entry.process = std::move(process);
    entry.wait = timing.firstWait;
    m_entries.push_back(std::move(entry));
  }
}

ProcessManager::~ProcessManager() {
  stop();
}

Result<void> ProcessManager::step(Time now) {
  // This process was stopped itself: what happened meanwhile says nothing about the others.
  constexpr Seconds longestGap{1.0};
  if (m_last && now - *m_last > longestGap) {
    for (Entry& entry : m_entries) entry.lastSign = now;
  }
  m_last = now;
  m_supervisor.poll();
  collectEnded(now);
  if (Result<void> started = startDue(now); !started) return started;
  for (Entry& entry : m_entries) {
    if (entry.handle != 0) watch(entry, now);
  }
  takeOutput();
  return {};
}

Result<void> ProcessManager::startDue(Time now) {
  for (Entry& entry : m_entries) {
    if (entry.handle != 0) continue;
    if (entry.everStarted) {
      if (now < entry.due) continue;
      ++m_restarts;
      (void)start(entry, now);
      continue;
    }
    // The first start keeps the order: nothing behind it before it runs.
    if (now < m_nextStart) break;
    if (Result<void> started = start(entry, now); !started) return started;
    m_nextStart = now + ticks(m_timing.startInterval);
    break;
  }
  return {};
}

Result<void> ProcessManager::start(Entry& entry, Time now) {
  writeIfPresent(m_board, entry.process.workingFlag, 0);  // what an earlier one left says nothing
  const Result<int> handle =
      m_supervisor.start({m_robot, entry.process.name, entry.process.command});
  if (!handle) {
    if (!entry.everStarted) return tl::unexpected<Error>(handle.error());
    plan(entry, now, handle.error().text());
    return {};
  }
  entry.handle = *handle;
  entry.everStarted = true;
  entry.started = entry.lastSign = now;
  entry.sleeps = 0;
  m_messages.push_back(entry.process.name + " started, process " +
                       std::to_string(child(*handle)->pid));
  return {};
}

void ProcessManager::collectEnded(Time now) {
  takeOutput();
  for (Entry& entry : m_entries) {
    const ChildStatus* status = entry.handle != 0 ? child(entry.handle) : nullptr;
    if (!status || status->state == ChildState::Running) continue;
    const std::string detail = status->detail;
    m_supervisor.forget(entry.handle);
    entry.handle = 0;
    plan(entry, now, "ended: " + detail);
  }
}

void ProcessManager::watch(Entry& entry, Time now) {
  bool sign = false;
  if (isPresent(entry.process.workingFlag)) {
    sign = m_board.read(entry.process.workingFlag) != 0;
    if (sign && m_clearFlags) m_board.write(entry.process.workingFlag, 0);
  } else {
    const std::uint64_t sleeps = sleepsOf(child(entry.handle)->pid);
    sign = sleeps != entry.sleeps;
    entry.sleeps = sleeps;
  }
  if (sign) entry.lastSign = now;
  if (now - entry.started >= m_timing.steadyAfter) entry.wait = m_timing.firstWait;
  if (now - entry.lastSign < m_timing.silentAfter) return;
  m_supervisor.stopChild(entry.handle);
  takeOutput();
  m_supervisor.forget(entry.handle);
  entry.handle = 0;
  plan(entry, now,
       "showed no sign of life for " + inSeconds(m_timing.silentAfter) + " and was ended");
}

void ProcessManager::plan(Entry& entry, Time now, const std::string& what) {
  entry.due = now + ticks(entry.wait);
  m_messages.push_back(entry.process.name + " " + what + "; it starts again in " +
                       inSeconds(entry.wait));
  entry.wait = std::min(2 * entry.wait, m_timing.longestWait);
}

void ProcessManager::takeOutput() {
  for (const ChildLine& line : m_supervisor.takeLines()) {
    const ChildStatus* status = child(line.handle);
    m_messages.push_back((status ? status->spec.name + ": " : "") + line.text);
  }
}

const ChildStatus* ProcessManager::child(int handle) const {
  const auto& children = m_supervisor.children();
  const auto found = std::find_if(children.begin(), children.end(),
                                  [handle](const ChildStatus& c) { return c.handle == handle; });
  return found == children.end() ? nullptr : &*found;
}

void ProcessManager::stop() {
  m_supervisor.stopAll();
  takeOutput();
  for (Entry& entry : m_entries) entry.handle = 0;
}

std::vector<std::string> ProcessManager::takeMessages() {
  return std::exchange(m_messages, {});
}

std::vector<pid_t> ProcessManager::pids() const {
  std::vector<pid_t> all;
  for (const Entry& entry : m_entries) {
    const ChildStatus* status = entry.handle != 0 ? child(entry.handle) : nullptr;
    all.push_back(status && status->state == ChildState::Running ? status->pid : 0);
  }
  return all;
}

}  // namespace pitchboard::link
