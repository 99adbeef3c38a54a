// SPDX-License-Identifier: GPL-3.0-or-later
// The clocks of a team's programs: who follows the match, and who keeps real time.
#include <robotlink/processes/process_manager.h>

#include <algorithm>
#include <csignal>
#include <thread>

#include "process_table.h"

namespace pitchboard::link {

const char* whyRealTime(ProcessClock clock) {
  switch (clock) {
    case ProcessClock::Match:
      return "";
    case ProcessClock::Real:
      return "its runtime profile says \"clock\": \"real\"";
    case ProcessClock::RealUntilRestart:
      return "restart to follow the match's speed";
    case ProcessClock::RealNoLibrary:
      return "libpitchboard_time.so is missing: install Pitchboard again";
    case ProcessClock::RealNotLoaded:
      return "the clock of the match cannot be loaded into it (static or setuid program)";
  }
  return "";
}

/// Before a start. At ×1 real time is the match's: nothing is loaded that could go wrong.
void ProcessManager::giveClock(Entry& entry, ChildSpec& spec, Time now) {
  ProcessStatus& status = entry.status;
  entry.clock.reset();
  entry.sawLibrary = false;
  status.clock = ProcessClock::Real;
  if (!entry.process.ownTime) return;
  if (!m_clocksFollow) {
    status.clock = ProcessClock::RealUntilRestart;
    entry.toldRealTime = false;
    return;
  }
  auto clock = ProgramClock::create();
  if (!clock) {
    status.clock = ProcessClock::RealNoLibrary;
    entry.toldRealTime = false;
    return;
  }
  entry.clock = std::move(*clock);
  status.clock = ProcessClock::Match;
  for (auto& variable : entry.clock->start(m_paused ? 0.0 : m_speed, now)) {
    spec.environment.push_back(std::move(variable));
  }
}

/// A program that runs is to keep this speed from now on.
void ProcessManager::askForSpeed(Entry& entry) {
  if (!entry.process.spec.foreign) return;
  ProcessStatus& status = entry.status;
  status.speed = m_speed;
  // Of clocks that keep real time it is known; of others it has to be seen.
  status.achieved = !entry.clock && m_speed > 1.0 ? 1.0 : 0.0;
  entry.cpuSeconds = 0.0;  // no second that is not half of this speed
  if (entry.clock || m_speed == 1.0 || std::exchange(entry.toldRealTime, true)) return;
  addNews(entry, ProcessNewsKind::RealTime, whyRealTime(status.clock));
}

void ProcessManager::setPaused(bool paused, Time now) {
  if (m_paused == paused) return;
  m_paused = paused;
  bool follows = false;
  // Their time stands still before they stop, and goes on before they go on.
  for (Entry& entry : m_entries) {
    if (!entry.child || !entry.clock) continue;
    entry.clock->setSpeed(paused ? 0.0 : m_speed, now);
    follows = true;
  }
  // A program that is stopped cannot set its timers again; this is the time that it has for it.
  constexpr std::chrono::milliseconds forTimers{5};
  if (paused && follows) std::this_thread::sleep_for(forTimers);
  for (Entry& entry : m_entries) {
    if (!entry.child || !entry.process.spec.foreign) continue;
    entry.child->signal(paused ? SIGSTOP : SIGCONT);
    entry.lastSign = entry.stoppedSince = now;
  }
}

void ProcessManager::setSpeed(double speed, Time now) {
  if (speed == m_speed) return;
  m_speed = speed;
  for (Entry& entry : m_entries) {
    if (!entry.child || !entry.process.spec.foreign) continue;
    if (entry.clock && !m_paused) entry.clock->setSpeed(speed, now);
    entry.sampled = now;
    askForSpeed(entry);
    changed();
  }
}

/// A static program loads no libraries, and the system loads none into one that is setuid.
void ProcessManager::lookForLibrary(Entry& entry, Time now) {
  constexpr std::chrono::seconds forLoading{1};
  ProcessStatus& status = entry.status;
  if (!entry.clock || entry.sawLibrary || now - status.started < forLoading) return;
  entry.sawLibrary = mapsFile(status.pid, ProgramClock::library);
  if (entry.sawLibrary) return;
  entry.clock.reset();
  status.clock = ProcessClock::RealNotLoaded;
  entry.toldRealTime = false;
  askForSpeed(entry);
}

bool ProcessManager::hasSegment(int id, int shmid) const {
  const Entry* entry = const_cast<ProcessManager*>(this)->find(id);
  return entry && entry->child && std::ranges::any_of(entry->child->all(), [shmid](pid_t pid) {
           return mapsSegment(pid, shmid);
         });
}

}  // namespace pitchboard::link
