// SPDX-License-Identifier: GPL-3.0-or-later
// The clocks of a team's programs: who follows the match, who keeps real time, whose waits hang.
#include <robotlink/processes/process_manager.h>

#include <cstdio>

#include "process_table.h"

namespace pitchboard::link {

/// Before a start. At ×1 real time is the match's: nothing is loaded that could go wrong.
void ProcessManager::giveClock(Entry& entry, ChildSpec& spec, Time now) {
  ProcessStatus& status = statusOf(entry);
  entry.time.reset();
  status.clock = ProcessClock::Real;
  if (!entry.process.ownTime) return;
  if (!m_clocksFollow) {
    status.clock = ProcessClock::RealUntilRestart;
    entry.toldRealTime = false;
    return;
  }
  auto time = FakeTime::create();
  if (!time) {
    status.clock = ProcessClock::RealNoLibrary;
    return;
  }
  entry.time = std::move(*time);
  status.clock = ProcessClock::Match;
  for (auto& variable : entry.time->start(m_paused ? 0.0 : m_speed, now)) {
    spec.environment.push_back(std::move(variable));
  }
}

/// A program that runs is to keep this speed from now on.
void ProcessManager::askForSpeed(Entry& entry) {
  if (!entry.process.spec.foreign) return;
  ProcessStatus& status = statusOf(entry);
  status.speed = m_speed;
  // Of clocks that keep real time it is known; of others it has to be seen.
  status.achieved = !entry.time && m_speed > 1.0 ? 1.0 : 0.0;
  entry.cpuSeconds = 0.0;  // no second that is not half of this speed
  if (entry.time || m_speed == 1.0 || std::exchange(entry.toldRealTime, true)) return;
  const char* why = status.clock == ProcessClock::RealUntilRestart
                        ? "restart to follow the match's speed"
                    : status.clock == ProcessClock::RealNoLibrary
                        ? "install the package faketime to follow the match's speed"
                        : "its runtime profile says \"clock\": \"real\"";
  m_news.push_back({ProcessNewsKind::RealTime, entry.process.spec.robot, entry.process.spec.name,
                    status.pid, why});
}

void ProcessManager::setPaused(bool paused, Time now) {
  if (m_paused == paused) return;
  m_paused = paused;
  for (Entry& entry : m_entries) {
    if (entry.handle == 0 || !entry.process.spec.foreign) continue;
    // Its time stands still before it stops, and goes on before it goes on.
    if (entry.time) entry.time->setSpeed(paused ? 0.0 : m_speed, now);
    m_supervisor.pauseChild(entry.handle, paused);
    entry.lastSign = entry.stoppedSince = now;
    entry.hangsSince.reset();
  }
}

void ProcessManager::setSpeed(double speed, Time now) {
  if (speed == m_speed) return;
  m_speed = speed;
  for (Entry& entry : m_entries) {
    if (entry.handle == 0 || !entry.process.spec.foreign) continue;
    if (entry.time && !m_paused) entry.time->setSpeed(speed, now);
    entry.sampled = now;
    askForSpeed(entry);
    changed();
  }
}

std::string ProcessManager::whyItHangs() const {
  char speed[40];
  std::snprintf(speed, sizeof speed, m_speed < 100.0 ? "\u00d7%.3g" : "\u00d7%.0f", m_speed);
  return std::string("its timed waits cannot follow ") +
         (m_speed == 1.0 ? "the clock of the match" : speed) +
         ". Restart the match at \u00d71, or set \"clock\": \"real\" in its runtime profile.";
}

/// libfaketime does not know all ways to wait: some of them begin to wait until the year that the
/// program's clock tells. A program that nobody listens to has stopped responding when a thread of
/// it waits like that and none has woken up for so long.
void ProcessManager::watchWaits(Entry& entry, Time now) {
  if (!entry.time || m_paused || entry.process.watch != ManagedProcess::Watch::Nobody) return;
  ProcessStatus& status = statusOf(entry);
  const ThreadWaits waits = threadWaits(status.pid);
  if (!waits.forEver || !entry.hangsSince || waits.sleeps != entry.threadSleeps) {
    entry.hangsSince = waits.forEver ? std::optional(now) : std::nullopt;
    entry.threadSleeps = waits.sleeps;
    if (!status.hangs.empty() && status.state == ProcessState::Silent) {
      status.state = ProcessState::Running;
      status.hangs.clear();
    }
  } else if (now - *entry.hangsSince >= entry.process.silentAfter && status.hangs.empty()) {
    status.hangs = whyItHangs();
    silenced(entry, now, status.hangs);
  }
}

bool ProcessManager::hasSegment(int id, int shmid) const {
  const ProcessStatus* one = status(id);
  if (!one || one->pid == 0) return false;
  if (mapsSegment(one->pid, shmid)) return true;
  for (const Entry& entry : m_entries) {
    if (entry.id != id) continue;
    for (const pid_t pid : m_supervisor.startedBy(entry.handle)) {
      if (mapsSegment(pid, shmid)) return true;
    }
  }
  return false;
}

}  // namespace pitchboard::link
