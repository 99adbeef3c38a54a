// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/processes/process_manager.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <iterator>
#include <set>

#include <base/duration_words.h>

#include "program_stamp.h"

namespace pitchboard::link {
namespace {

using Seconds = RestartRule::Seconds;
using Ticks = std::chrono::steady_clock::duration;

constexpr Seconds sampleInterval{1.0};
constexpr std::size_t mostLines = ProcessSupervisor::maxLines;

Ticks ticks(Seconds seconds) {
  return std::chrono::duration_cast<Ticks>(seconds);
}

}  // namespace

std::string inSeconds(Seconds seconds) {
  if (seconds >= std::chrono::minutes(1)) return durationWords(seconds.count());
  char text[32];
  std::snprintf(text, sizeof text, "%.3g s", seconds.count());
  return text;
}

ProcessManager::~ProcessManager() {
  stopAll();
}

ProcessManager::Entry* ProcessManager::find(int id) {
  const auto found = std::find_if(m_entries.begin(), m_entries.end(),
                                  [id](const Entry& entry) { return entry.id == id; });
  return found == m_entries.end() ? nullptr : &*found;
}

ProcessStatus& ProcessManager::statusOf(const Entry& entry) {
  return m_statuses[static_cast<std::size_t>(&entry - m_entries.data())];
}

const ProcessStatus* ProcessManager::status(int id) const {
  const auto found = std::find_if(m_statuses.begin(), m_statuses.end(),
                                  [id](const ProcessStatus& one) { return one.id == id; });
  return found == m_statuses.end() ? nullptr : &*found;
}

const ChildStatus* ProcessManager::child(int handle) const {
  const auto& children = m_supervisor.children();
  const auto found = std::find_if(children.begin(), children.end(),
                                  [handle](const ChildStatus& c) { return c.handle == handle; });
  return found == children.end() ? nullptr : &*found;
}

Result<int> ProcessManager::add(const ManagedProcess& process, Blackboard& board, Time now) {
  const RobotId robot = process.spec.robot;
  const bool isFirst = std::none_of(m_entries.begin(), m_entries.end(), [robot](const Entry& one) {
    return one.process.spec.robot == robot;
  });
  const bool waits = std::any_of(m_entries.begin(), m_entries.end(), [robot](const Entry& one) {
    return one.process.spec.robot == robot && !one.everStarted;
  });
  Entry entry;
  entry.id = m_nextId++;
  entry.process = process;
  entry.board = &board;
  entry.wait = process.restart.firstWait;
  ProcessStatus status;
  status.id = entry.id;
  status.robot = robot;
  status.name = process.spec.name;
  status.foreign = process.spec.foreign;
  m_entries.push_back(std::move(entry));
  m_statuses.push_back(std::move(status));
  changed();
  if (waits || (process.delay > 0.0 && !isFirst)) return m_entries.back().id;
  if (auto started = startNow(m_entries.back(), now); !started) {
    m_entries.pop_back();
    m_statuses.pop_back();
    return tl::unexpected(started.error());
  }
  return m_entries.back().id;
}

void ProcessManager::remove(RobotId robot) {
  m_supervisor.stop(robot);
  takeOutput();
  for (const Entry& entry : m_entries) {
    if (entry.process.spec.robot == robot && entry.handle != 0) m_supervisor.forget(entry.handle);
  }
  std::erase_if(m_statuses, [robot](const ProcessStatus& one) { return one.robot == robot; });
  std::erase_if(m_entries, [robot](const Entry& one) { return one.process.spec.robot == robot; });
  m_lastStart.erase(robot);
  changed();
}

void ProcessManager::removeOne(int id) {
  Entry* entry = find(id);
  if (!entry) return;
  if (entry->handle != 0) endChild(*entry);
  const auto index = entry - m_entries.data();
  m_statuses.erase(m_statuses.begin() + index);
  m_entries.erase(m_entries.begin() + index);
  changed();
}

void ProcessManager::stopAll() {
  m_supervisor.stopAll();
  takeOutput();
  for (Entry& entry : m_entries) {
    if (entry.handle == 0) continue;
    m_supervisor.forget(entry.handle);
    entry.handle = 0;
    ProcessStatus& status = statusOf(entry);
    status.state = ProcessState::Stopped;
    status.pid = 0;
  }
  changed();
}

Result<void> ProcessManager::step(Time now) {
  // This process was stopped itself: what happened meanwhile says nothing about the others.
  constexpr Seconds longestGap{1.0};
  if (m_last && now - *m_last > longestGap) {
    for (Entry& entry : m_entries) entry.lastSign = entry.stoppedSince = now;
  }
  m_last = now;
  m_supervisor.poll();
  collectEnded(now);
  const Result<void> started = startDue(now);
  for (Entry& entry : m_entries) {
    if (entry.handle != 0) watch(entry, now);
    if (entry.handle != 0 && now - entry.sampled >= sampleInterval) {
      sample(entry, now);
      if (entry.process.watchFile) watchFile(entry, now);
    }
  }
  takeOutput();
  return started;
}

Result<void> ProcessManager::startDue(Time now) {
  Result<void> outcome;
  std::set<RobotId> waiting;  // robots with a process whose turn is not yet over
  for (Entry& entry : m_entries) {
    const RobotId robot = entry.process.spec.robot;
    const ProcessState state = statusOf(entry).state;
    if (state == ProcessState::Restarting) {
      if (now >= entry.due) (void)startNow(entry, now);
    } else if (state == ProcessState::Waiting && waiting.insert(robot).second) {
      const auto last = m_lastStart.find(robot);
      if (last != m_lastStart.end() && now < last->second + ticks(Seconds(entry.process.delay))) {
        continue;
      }
      if (auto started = startNow(entry, now); !started && outcome) outcome = started;
    }
  }
  return outcome;
}

Result<void> ProcessManager::startNow(Entry& entry, Time now) {
  ManagedProcess& process = entry.process;
  if (entry.board) writeIfPresent(*entry.board, process.heartbeat, 0);  // what an earlier one left
  ChildSpec spec = process.spec;
  giveClock(entry, spec, now);
  Result<int> handle = 0;
  if (process.prepare) {
    if (auto prepared = process.prepare(spec); !prepared) handle = tl::unexpected(prepared.error());
  }
  if (handle) handle = m_supervisor.start(spec);
  m_lastStart[spec.robot] = now;
  const bool again = std::exchange(entry.everStarted, true);
  ProcessStatus& status = statusOf(entry);
  changed();
  if (!handle) {
    ended(entry, now, true, handle.error().text(), false);
    return tl::unexpected<Error>(handle.error());
  }
  entry.handle = *handle;
  entry.lastSign = entry.stoppedSince = entry.sampled = now;
  entry.sleeps = 0;
  entry.cpuSeconds = entry.cyclesPerSecond = 0.0;
  entry.programStamp = process.watchFile ? programStamp(process.spec) : std::string();
  entry.newStamp.clear();
  status.state = ProcessState::Running;
  status.pid = child(*handle)->pid;
  status.started = now;
  status.detail.clear();
  if (again) ++status.restarts;
  if (m_paused && spec.foreign) m_supervisor.pauseChild(entry.handle, true);
  m_news.push_back({again ? ProcessNewsKind::Restarted : ProcessNewsKind::Started,
                    spec.robot,
                    spec.name,
                    status.pid,
                    {}});
  askForSpeed(entry);
  return {};
}

void ProcessManager::collectEnded(Time now) {
  takeOutput();
  for (Entry& entry : m_entries) {
    const ChildStatus* status = entry.handle != 0 ? child(entry.handle) : nullptr;
    if (!status || status->state == ChildState::Running) continue;
    const bool died = status->state == ChildState::Failed;
    const std::string detail = status->detail;
    m_supervisor.forget(entry.handle);
    entry.handle = 0;
    ended(entry, now, died, detail, false);
  }
}

/// It does not run any more, or could not be started.
void ProcessManager::ended(Entry& entry, Time now, bool died, const std::string& detail,
                           bool byHand) {
  ProcessStatus& status = statusOf(entry);
  ProcessNews news{died ? ProcessNewsKind::Died : ProcessNewsKind::Ended, entry.process.spec.robot,
                   entry.process.spec.name, status.pid, detail};
  if (died && !status.lastLines.empty()) news.lastWords = status.lastLines.back();
  status.pid = 0;
  status.cpu = 0.0;
  status.memoryBytes = 0;
  status.heartbeatAge.reset();
  status.detail = detail;
  changed();
  const RestartPolicy policy = entry.process.restart.policy;
  const bool again =
      !byHand && (policy == RestartPolicy::Always || (policy == RestartPolicy::OnFailure && died));
  if (again) {
    planRestart(entry, now, std::move(news));
  } else {
    status.state = byHand ? ProcessState::Stopped : ProcessState::Ended;
    m_news.push_back(std::move(news));
  }
}

void ProcessManager::planRestart(Entry& entry, Time now, ProcessNews news) {
  const RestartRule& rule = entry.process.restart;
  ProcessStatus& status = statusOf(entry);
  if (rule.giveUpAfter > 0 && entry.inARow >= rule.giveUpAfter) {
    status.state = ProcessState::GivenUp;
    m_news.push_back(std::move(news));
    m_news.push_back({ProcessNewsKind::GivenUp, entry.process.spec.robot, entry.process.spec.name,
                      0, std::to_string(entry.inARow) + " restarts did not help"});
    return;
  }
  ++entry.inARow;
  news.restartIn = entry.wait.count();
  entry.due = now + ticks(entry.wait);
  entry.wait = std::min(2 * entry.wait, rule.longestWait);
  status.state = ProcessState::Restarting;
  status.nextStart = entry.due;
  m_news.push_back(std::move(news));
}

void ProcessManager::endChild(Entry& entry) {
  m_supervisor.stopChild(entry.handle);
  takeOutput();
  m_supervisor.forget(entry.handle);
  entry.handle = 0;
}

void ProcessManager::start(int id, Time now) {
  Entry* entry = find(id);
  if (!entry || entry->handle != 0) return;
  entry->wait = entry->process.restart.firstWait;
  entry->inARow = 0;
  (void)startNow(*entry, now);
}

void ProcessManager::stop(int id) {
  Entry* entry = find(id);
  if (!entry) return;
  ProcessStatus& status = statusOf(*entry);
  if (entry->handle != 0) {
    endChild(*entry);
    ended(*entry, {}, false, "it was asked to", true);
  } else {
    status.state = ProcessState::Stopped;
    status.detail.clear();
    changed();
  }
}

void ProcessManager::restart(int id, Time now) {
  stop(id);
  start(id, now);
}

void ProcessManager::kill(int id) {
  const Entry* entry = find(id);
  if (entry && entry->handle != 0) m_supervisor.signalChild(entry->handle, SIGKILL);
}

void ProcessManager::takeOutput() {
  for (ChildLine& line : m_supervisor.takeLines()) {
    const auto entry = std::find_if(m_entries.begin(), m_entries.end(), [&line](const Entry& one) {
      return one.handle == line.handle;
    });
    if (entry == m_entries.end()) continue;
    auto& last = statusOf(*entry).lastLines;
    if (last.size() == ProcessStatus::mostLastLines) last.erase(last.begin());
    last.push_back(line.text);
    m_lines.push_back({entry->process.spec.robot, entry->process.spec.name, std::move(line.text)});
    changed();
  }
  if (m_lines.size() > mostLines) {
    m_lines.erase(m_lines.begin(), m_lines.end() - static_cast<std::ptrdiff_t>(mostLines));
  }
}

std::vector<ProcessNews> ProcessManager::takeNews() {
  return std::exchange(m_news, {});
}

std::vector<ProcessLine> ProcessManager::takeLines() {
  return std::exchange(m_lines, {});
}

}  // namespace pitchboard::link
