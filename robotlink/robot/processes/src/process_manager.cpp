// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/processes/process_manager.h>

#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <iterator>
#include <set>
#include <thread>

#include <base/duration_text.h>
#include <base/system_reason.h>
#include <base/try.h>
#include <robotlink/blackboard/system_v.h>
#include <robotlink/processes/guard.h>

#include "process_table.h"

namespace pitchboard::link {
namespace {

using namespace std::chrono_literals;
using Seconds = RestartRule::Seconds;
using Ticks = std::chrono::steady_clock::duration;

constexpr Seconds sampleInterval{1.0};
constexpr auto grace = 500ms;      // between the stop signal and SIGKILL
constexpr auto killPatience = 5s;  // longer than this only in a stuck system call

Ticks ticks(Seconds seconds) {
  return std::chrono::duration_cast<Ticks>(seconds);
}

}  // namespace

std::string inSeconds(Seconds seconds) {
  if (seconds >= std::chrono::minutes(1)) return durationText(seconds.count());
  char text[32];
  std::snprintf(text, sizeof text, "%.3g s", seconds.count());
  return text;
}

ProcessManager::ProcessManager(std::string robotProgram)
    : m_program(std::move(robotProgram)), m_epoll(::epoll_create1(EPOLL_CLOEXEC)) {}

ProcessManager::~ProcessManager() {
  stopAll();
  if (!m_guard) return;
  sendToGuard(guardMessages::done);
  // It ends at once; only one that was stopped would keep us.
  const auto last = std::chrono::steady_clock::now() + killPatience;
  while (::waitpid(m_guardPid, nullptr, WNOHANG) == 0 && std::chrono::steady_clock::now() < last) {
    std::this_thread::sleep_for(1ms);
  }
}

Result<void> ProcessManager::keepGuard() {
  if (m_guard) return {};
  if (m_program.empty()) {
    return failure(ErrorCode::InvalidArgument,
                   "cannot start the robots' processes: the path of pitchboard-robot is not "
                   "known; use inline cognition or give the path");
  }
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
    return failure(ErrorCode::SystemError,
                   "cannot start the guard of the robots' processes: " + systemReason(errno));
  }
  UniqueFd ours(ends[0]);
  const UniqueFd its(ends[1]);
  SpawnRequest request{{m_program, std::string(guardCommand)}};
  request.input = its.get();
  request.outlives = true;
  const auto started = TRY(spawn(request));
  m_guardPid = started.pid;
  m_guard = std::move(ours);
  return {};
}

void ProcessManager::guardSegment(const Blackboard& board) {
  if (!m_guard || !board.created()) return;
  if (const auto info = SystemVSegments::info(board.key())) {
    sendToGuard(guardMessages::segment(info->key, info->shmid));
  }
}

void ProcessManager::sendToGuard(const std::string& line) {
  // A guard that is gone is no reason to end: MSG_NOSIGNAL instead of SIGPIPE.
  (void)::send(m_guard.get(), line.data(), line.size(), MSG_NOSIGNAL);
}

ProcessManager::Entry* ProcessManager::find(int id) {
  const auto found =
      std::ranges::find_if(m_entries, [id](const Entry& entry) { return entry.status.id == id; });
  return found == m_entries.end() ? nullptr : &*found;
}

const ProcessStatus* ProcessManager::status(int id) const {
  const Entry* entry = const_cast<ProcessManager*>(this)->find(id);
  return entry ? &entry->status : nullptr;
}

std::vector<ProcessStatus> ProcessManager::statuses() const {
  std::vector<ProcessStatus> all;
  for (const Entry& entry : m_entries) all.push_back(entry.status);
  return all;
}

Result<int> ProcessManager::add(const ManagedProcess& process, Blackboard& board, Time now) {
  const RobotId robot = process.spec.robot;
  const bool isFirst = std::ranges::none_of(
      m_entries, [robot](const Entry& one) { return one.status.robot == robot; });
  const bool waits = std::ranges::any_of(m_entries, [robot](const Entry& one) {
    return one.status.robot == robot && !one.everStarted;
  });
  Entry& entry = m_entries.emplace_back();
  entry.process = process;
  entry.board = &board;
  entry.wait = process.restart.firstWait;
  entry.status.id = m_nextId++;
  entry.status.robot = robot;
  entry.status.name = process.spec.name;
  entry.status.command = process.spec.command;
  entry.status.isTeamProgram = process.spec.isTeamProgram;
  changed();
  if (waits || (process.delay > 0.0 && !isFirst)) return entry.status.id;
  if (auto started = startNow(entry, now); !started) {
    m_entries.pop_back();
    return tl::unexpected(started.error());
  }
  return entry.status.id;
}

void ProcessManager::remove(RobotId robot) {
  std::vector<Entry*> its;
  for (Entry& entry : m_entries) {
    if (entry.status.robot == robot) its.push_back(&entry);
  }
  end(its);
  std::erase_if(m_entries, [robot](const Entry& one) { return one.status.robot == robot; });
  m_lastStart.erase(robot);
  changed();
}

void ProcessManager::removeOne(int id) {
  Entry* entry = find(id);
  if (!entry) return;
  end({entry});
  m_entries.erase(m_entries.begin() + (entry - m_entries.data()));
  changed();
}

void ProcessManager::stopAll() {
  std::vector<Entry*> running;
  for (Entry& entry : m_entries) {
    if (entry.child) running.push_back(&entry);
  }
  end(running);
  for (Entry* entry : running) {
    entry->status.state = ProcessState::Stopped;
    entry->status.pid = 0;
  }
  changed();
}

Result<void> ProcessManager::step(Time now) {
  // This process was stopped itself: what happened meanwhile says nothing about the others.
  constexpr Seconds maxGap{1.0};
  if (m_last && now - *m_last > maxGap) {
    for (Entry& entry : m_entries) {
      entry.lastSign = entry.stoppedSince = now;
      entry.lastSignMatch = m_matchSeconds;
    }
  }
  m_last = now;
  takeEpollEvents();
  for (Entry& entry : m_entries) {
    if (entry.isWatched && !entry.hasNews && now - entry.sampled < sampleInterval) continue;
    if (const auto end = poll(entry)) ended(entry, now, end->failed, end->detail, false);
    tellLeftOut(entry, now);
  }
  Result<void> started = startDue(now);
  for (Entry& entry : m_entries) {
    if (entry.child) watch(entry, now);
    if (entry.child && now - entry.sampled >= sampleInterval) {
      sample(entry, now);
      if (entry.process.watchFile) watchFile(entry, now);
    }
  }
  return started;
}

/// Marks those that have something to tell, so that the others need not be asked.
void ProcessManager::takeEpollEvents() {
  epoll_event ready[64];
  for (int count = 1; count > 0;) {
    count = ::epoll_wait(m_epoll.get(), ready, static_cast<int>(std::size(ready)), 0);
    for (int i = 0; i < count; ++i) {
      if (Entry* entry = find(static_cast<int>(ready[i].data.u64))) entry->hasNews = true;
    }
  }
}

/// Takes what it wrote, and how it ended.
std::optional<ChildProcess::End> ProcessManager::poll(Entry& entry) {
  entry.hasNews = false;
  if (!entry.child) return {};
  std::vector<std::string> lines;
  auto end = entry.child->poll(lines);
  if (end) entry.child.reset();
  if (!lines.empty()) changed();
  ProcessStatus& status = entry.status;
  const std::size_t newest = std::min(lines.size(), ProcessStatus::maxLastLines);
  status.lastLines.insert(status.lastLines.end(), lines.end() - static_cast<std::ptrdiff_t>(newest),
                          lines.end());
  if (status.lastLines.size() > ProcessStatus::maxLastLines) {
    status.lastLines.erase(
        status.lastLines.begin(),
        status.lastLines.end() - static_cast<std::ptrdiff_t>(ProcessStatus::maxLastLines));
  }
  const std::size_t kept = std::min(lines.size(), maxLines - entry.waitingLines);
  for (std::size_t i = 0; i < kept; ++i) {
    m_lines.push_back({status.robot, status.name, std::move(lines[i])});
  }
  entry.waitingLines += kept;
  status.linesLeftOut += lines.size() - kept;
  return end;
}

/// Says in the log of a program, at most once a second, how many of its lines are not there.
void ProcessManager::tellLeftOut(Entry& entry, Time now) {
  constexpr Seconds interval{1.0};
  const std::uint64_t count = entry.status.linesLeftOut - entry.toldLeftOut;
  if (count == 0 || (entry.child && now - entry.toldAt < interval)) return;
  entry.toldLeftOut = entry.status.linesLeftOut;
  entry.toldAt = now;
  m_lines.push_back({entry.status.robot, entry.status.name,
                     std::to_string(count) + (count == 1 ? " line was" : " lines were") +
                         " left out: the program writes too much to keep all of it",
                     true});
}

/// Their stop signals, then SIGKILL to what is left. Returns when all are gone.
void ProcessManager::end(const std::vector<Entry*>& entries) {
  const auto waitFor = [this, &entries](std::chrono::milliseconds patience) {
    const auto last = std::chrono::steady_clock::now() + patience;
    const auto runs = [this](Entry* entry) { return (void)poll(*entry), entry->child.has_value(); };
    while (std::ranges::count_if(entries, runs) > 0 && std::chrono::steady_clock::now() < last) {
      std::this_thread::sleep_for(1ms);
    }
  };
  waitFor(0ms);
  for (const Entry* entry : entries) {
    if (!entry->child) continue;
    entry->child->signal(entry->process.spec.stopSignal);
    entry->child->signal(SIGCONT);  // one that is stopped would never learn of it
  }
  waitFor(grace);
  for (const Entry* entry : entries) {
    if (entry->child) entry->child->signal(SIGKILL);
  }
  waitFor(killPatience);
  for (Entry* entry : entries) entry->child.reset();
}

Result<void> ProcessManager::startDue(Time now) {
  Result<void> outcome;
  std::set<RobotId> waiting;  // robots with a process whose turn is not yet over
  for (Entry& entry : m_entries) {
    const RobotId robot = entry.status.robot;
    const ProcessState state = entry.status.state;
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
  const ManagedProcess& process = entry.process;
  ProcessStatus& status = entry.status;
  if (entry.board) writeIfPresent(*entry.board, process.heartbeat, 0);  // what an earlier one left
  ChildSpec spec = process.spec;
  giveClock(entry, spec, now);
  Result<void> outcome = process.prepare ? process.prepare(spec) : Result<void>();
  if (outcome) {
    auto child = ChildProcess::start(spec, m_program);
    if (child) {
      entry.child = std::move(*child);
      entry.isWatched =
          entry.child->addTo(m_epoll.get(), static_cast<std::uint64_t>(entry.status.id));
    } else {
      outcome = tl::unexpected(child.error());
    }
  }
  m_lastStart[status.robot] = now;
  const bool again = std::exchange(entry.everStarted, true);
  changed();
  if (!outcome) {
    ended(entry, now, true, outcome.error().text(), false);
    return outcome;
  }
  entry.lastSign = entry.stoppedSince = entry.sampled = now;
  entry.lastSignMatch = m_matchSeconds;
  entry.everSigned = false;
  entry.sleeps = 0;
  entry.cpuSeconds = entry.cyclesPerSecond = entry.missedCycles = 0.0;
  status.cycles = status.missedCycles = 0;
  entry.programStamp = process.watchFile ? programStamp(process.spec) : std::string();
  entry.newStamp.clear();
  status.state = ProcessState::Running;
  status.pid = entry.child->pid();
  status.started = now;
  status.detail.clear();
  if (again) ++status.restarts;
  if (m_paused && spec.isTeamProgram) entry.child->signal(SIGSTOP);
  addNews(entry, again ? ProcessNewsKind::Restarted : ProcessNewsKind::Started);
  askForSpeed(entry, now);
  return {};
}

void ProcessManager::addNews(const Entry& entry, ProcessNewsKind kind, const std::string& detail) {
  m_news.push_back({kind, entry.status.robot, entry.status.name, entry.status.pid, detail});
}

/// Called when a process has ended or could not be started.
void ProcessManager::ended(Entry& entry, Time now, bool died, const std::string& detail,
                           bool byHand) {
  ProcessStatus& status = entry.status;
  ProcessNews news{died ? ProcessNewsKind::Died : ProcessNewsKind::Ended, status.robot, status.name,
                   status.pid, detail};
  if (died && !status.lastLines.empty()) news.lastOutput = status.lastLines.back();
  status.pid = 0;
  status.cpu = 0.0;
  status.memoryBytes = 0;
  status.heartbeatAge.reset();
  status.detail = detail;
  changed();
  const RestartPolicy policy = entry.process.restart.policy;
  const bool again =
      !byHand && (policy == RestartPolicy::Always || (policy == RestartPolicy::OnFailure && died));
  if (died || again) {
    ++status.deaths;
    status.lastDeath = detail;
    if (!status.lastLines.empty()) status.lastDeath += "; last output: " + status.lastLines.back();
  }
  if (again) {
    planRestart(entry, now, std::move(news));
  } else {
    status.state = byHand ? ProcessState::Stopped : ProcessState::Ended;
    m_news.push_back(std::move(news));
  }
}

void ProcessManager::planRestart(Entry& entry, Time now, ProcessNews news) {
  const RestartRule& rule = entry.process.restart;
  ProcessStatus& status = entry.status;
  if (rule.giveUpAfter > 0 && entry.inARow >= rule.giveUpAfter) {
    status.state = ProcessState::GivenUp;
    m_news.push_back(std::move(news));
    addNews(entry, ProcessNewsKind::GivenUp, std::to_string(entry.inARow) + " restarts failed");
    return;
  }
  ++entry.inARow;
  news.restartIn = entry.wait.count();
  entry.due = now + ticks(entry.wait);
  entry.wait = std::min(2 * entry.wait, rule.maxWait);
  status.state = ProcessState::Restarting;
  status.nextStart = entry.due;
  m_news.push_back(std::move(news));
}

void ProcessManager::start(int id, Time now) {
  Entry* entry = find(id);
  if (!entry || entry->child) return;
  entry->wait = entry->process.restart.firstWait;
  entry->inARow = 0;
  const int restarts = entry->status.restarts;
  (void)startNow(*entry, now);
  entry->status.restarts = restarts;
}

void ProcessManager::stop(int id) {
  Entry* entry = find(id);
  if (!entry) return;
  if (entry->child) {
    end({entry});
    ended(*entry, {}, false, "", true);
  } else {
    entry->status.state = ProcessState::Stopped;
    entry->status.detail.clear();
    changed();
  }
}

void ProcessManager::restart(int id, Time now) {
  stop(id);
  start(id, now);
  if (Entry* entry = find(id)) ++entry->status.restarts;
}

void ProcessManager::kill(int id) {
  const Entry* entry = find(id);
  if (entry && entry->child) entry->child->signal(SIGKILL);
}

std::vector<ProcessNews> ProcessManager::drainNews() {
  return std::exchange(m_news, {});
}

std::vector<ProcessLine> ProcessManager::drainLines() {
  for (Entry& entry : m_entries) entry.waitingLines = 0;
  return std::exchange(m_lines, {});
}

}  // namespace pitchboard::link
