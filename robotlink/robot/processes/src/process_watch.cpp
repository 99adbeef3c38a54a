// SPDX-License-Identifier: GPL-3.0-or-later
// What the manager sees of processes that run: signs of life, use of the computer, pace, files.
#include <robotlink/processes/process_manager.h>

#include <algorithm>
#include <cmath>

#include "process_table.h"

namespace pitchboard::link {
namespace {

using Seconds = RestartRule::Seconds;
using Watch = ManagedProcess::Watch;

}  // namespace

void ProcessManager::watch(Entry& entry, Time now) {
  const ManagedProcess& process = entry.process;
  if (process.watch == Watch::Variable && entry.board) {
    if (readOr(*entry.board, process.heartbeat) != 0) {
      if (process.clears) writeIfPresent(*entry.board, process.heartbeat, 0);
      showSign(entry, now);
    }
  } else if (process.watch == Watch::Sleeps) {
    const auto rhythm = processRhythm(entry.status.pid);
    if (rhythm && rhythm->sleeps != entry.sleeps) {
      entry.sleeps = rhythm->sleeps;
      showSign(entry, now);
    }
  }
  if (m_paused && process.spec.isTeamProgram) entry.lastSign = entry.stoppedSince = now;
  if (now - entry.status.started >= process.restart.steadyAfter) {
    entry.wait = process.restart.firstWait;
    entry.inARow = 0;
  }
  // A team's program may block for long before its first cycle.
  const bool listens = (process.watch == Watch::Variable || process.watch == Watch::Sleeps) &&
                       (entry.everSigned || !process.spec.isTeamProgram);
  ProcessStatus& status = entry.status;
  if (listens && isOverdue(entry, now)) {
    if (status.state == ProcessState::NotResponding) return;  // it has been reported
    reportOverdue(entry, now, "no sign of life for " + inSeconds(process.responseTimeout));
  } else if (listens && status.state == ProcessState::NotResponding) {
    status.state = ProcessState::Running;
    changed();
  }
}

void ProcessManager::showSign(Entry& entry, Time now) const {
  entry.lastSign = now;
  entry.lastSignMatch = m_matchSeconds;
  entry.everSigned = true;
}

/// A program that lives in the match's time has match time to show that it lives, but at a high
/// speed not less of the computer's than it takes to notice it.
bool ProcessManager::isOverdue(const Entry& entry, Time now) const {
  constexpr Seconds least{1.0};
  const Seconds responseTimeout = entry.process.responseTimeout;
  if (!entry.clock) return now - entry.lastSign >= responseTimeout;
  return Seconds(m_matchSeconds - entry.lastSignMatch) >= responseTimeout &&
         now - entry.lastSign >= least;
}

void ProcessManager::reportOverdue(Entry& entry, Time now, const std::string& detail) {
  ProcessStatus& status = entry.status;
  const bool again =
      entry.process.watch != Watch::None && entry.process.restart.policy != RestartPolicy::Never;
  if (!again && status.state == ProcessState::NotResponding) return;
  ProcessNews news{ProcessNewsKind::NotResponding, status.robot, status.name, status.pid, detail};
  status.detail = detail;
  changed();
  if (!again) {
    status.state = ProcessState::NotResponding;
    m_news.push_back(std::move(news));
    return;
  }
  end({&entry});
  status.pid = 0;
  planRestart(entry, now, std::move(news));
}

void ProcessManager::setResponding(int id, bool responding, Time now) {
  Entry* entry = find(id);
  if (!entry || !entry->child) return;
  ProcessStatus& status = entry->status;
  if (!responding) {
    reportOverdue(*entry, now, "no cycle done for " + inSeconds(entry->process.responseTimeout));
  } else if (status.state == ProcessState::NotResponding) {
    status.state = ProcessState::Running;
    changed();
  }
  if (responding) showSign(*entry, now);
}

void ProcessManager::sample(Entry& entry, Time now) {
  const auto use = processUse(entry.status.pid);
  if (!use) return;
  ProcessStatus& status = entry.status;
  const ProcessStatus before = status;
  const double passed = Seconds(now - entry.sampled).count();
  const double own = ownSeconds(entry, now);
  if (entry.cpuSeconds > 0.0) status.cpu = (use->cpuSeconds - entry.cpuSeconds) / passed;
  const auto rhythm = status.isTeamProgram ? processRhythm(status.pid) : std::nullopt;
  if (rhythm) {
    const double ready = rhythm->readySeconds.value_or(use->cpuSeconds);
    if (entry.cpuSeconds > 0.0 && !m_paused) {
      measurePace(entry, rhythm->sleeps - entry.sampledSleeps,
                  (ready - entry.readySeconds) / passed, own - entry.sampledSeconds);
    }
    entry.sampledSleeps = rhythm->sleeps;
    entry.readySeconds = ready;
  }
  entry.sampledSeconds = own;
  entry.cpuSeconds = std::max(use->cpuSeconds, 1e-9);
  entry.sampled = now;
  status.memoryBytes = use->memoryBytes;
  // No sign of life is expected while the match is paused.
  if (entry.process.watch != Watch::None && !m_paused) {
    status.heartbeatAge = Seconds(now - entry.lastSign).count();
  }
  if (status != before) changed();
  lookForLibrary(entry, now);
  // Watch::Variable and Watch::Sleeps notice a stopped process by themselves.
  const bool listens =
      entry.process.watch == Watch::Variable || entry.process.watch == Watch::Sleeps;
  if (use->state != 'T' || listens) {
    entry.stoppedSince = now;
    if (entry.process.watch == Watch::None && status.state == ProcessState::NotResponding) {
      status.state = ProcessState::Running;
      changed();
    }
  } else if (now - entry.stoppedSince >= entry.process.responseTimeout) {
    reportOverdue(entry, now,
                  "stopped by a signal for " + inSeconds(entry.process.responseTimeout));
  }
}

/// How many cycles a program does in a second of its own time is the same at every speed, as long
/// as it has time to sleep. What it does at ×1 is what it has to do; at a higher speed, that is
/// learned only while work takes next to nothing of its time. One that never sleeps is one that
/// nobody can judge. `newSleeps`, `share` (in which it worked, or waited for a core) and
/// `ownSeconds` (how far its own clocks went) since the last look.
void ProcessManager::measurePace(Entry& entry, std::uint64_t newSleeps, double share,
                                 double ownSeconds) {
  constexpr double busy = 0.9, idle = 0.1;
  if (ownSeconds <= 0.0) return;
  ProcessStatus& status = entry.status;
  const double speed = entry.clock ? m_speed : 1.0;
  const auto cycles = static_cast<double>(newSleeps);
  const double rate = cycles / ownSeconds;
  share = std::clamp(share, 0.0, 1.0);
  if (share < (speed <= 1.0 ? busy : idle)) {
    entry.cyclesPerSecond = entry.cyclesPerSecond > 0.0 ? (entry.cyclesPerSecond + rate) / 2 : rate;
    status.achieved = speed;
  } else if (entry.cyclesPerSecond > 0.0) {
    // While it sleeps its time passes as it should: no more than the rest can be lost.
    status.achieved = speed * std::clamp(rate / entry.cyclesPerSecond, 1.0 - share, 1.0);
  } else if (share < busy) {
    status.achieved = speed * (1.0 - share);
  }
  status.cycles += newSleeps;
  if (fallsBehind(status)) {
    entry.missedCycles += std::max(0.0, entry.cyclesPerSecond * ownSeconds - cycles);
  }
  status.missedCycles = static_cast<std::uint64_t>(std::lround(entry.missedCycles));
}

void ProcessManager::watchFile(Entry& entry, Time now) {
  const std::string stamp = programStamp(entry.process.spec);
  if (stamp.empty() || stamp == entry.programStamp) return;
  // The file may still be being written, so it has to be unchanged since the last look.
  if (entry.newStamp != stamp) {
    entry.newStamp = stamp;
  } else {
    restart(entry.status.id, now);
  }
}

}  // namespace pitchboard::link
