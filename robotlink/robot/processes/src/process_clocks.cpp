// SPDX-License-Identifier: GPL-3.0-or-later
// The clocks of a team's programs: who follows the match, and who keeps real time.
#include <robotlink/processes/process_manager.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <thread>

#include "process_table.h"

namespace pitchboard::link {

std::string programOf(const std::vector<std::string>& command) {
  if (command.empty()) return {};
  const auto file = [](const std::string& path) {
    return std::filesystem::path(path).filename().string();
  };
  const std::string first = file(command.front());
  constexpr std::array interpreters{"python", "sh",   "bash", "dash", "zsh",
                                    "node",   "ruby", "perl", "lua",  "env"};
  const std::string plain = first.substr(0, first.find_first_of("0123456789."));
  if (std::ranges::find(interpreters, plain) == interpreters.end()) return first;
  const auto script = std::find_if(command.begin() + 1, command.end(), [](const auto& argument) {
    return argument.find('.') != std::string::npos && !argument.starts_with('-');
  });
  return script == command.end() ? first : file(*script);
}

const char* whyRealTime(ProcessClock clock) {
  switch (clock) {
    case ProcessClock::Match:
      return "";
    case ProcessClock::Real:
      return "its runtime profile says \"clock\": \"real\"";
    case ProcessClock::RealNoLibrary:
      return "libpitchboard_time.so is missing: install Pitchboard again";
    case ProcessClock::RealNotLoaded:
      return "the clock of the match cannot be loaded into it (static or setuid program)";
  }
  return "";
}

bool fallsBehind(const ProcessStatus& program) {
  constexpr double keepsUp = 0.95;
  return program.isTeamProgram && program.achieved > 0.0 &&
         program.achieved < keepsUp * program.speed;
}

/// Before a start.
void ProcessManager::giveClock(Entry& entry, ChildSpec& spec, Time now) {
  ProcessStatus& status = entry.status;
  entry.clock.reset();
  entry.sawLibrary = false;
  status.clock = ProcessClock::Real;
  if (!entry.process.ownTime) return;
  auto clock = ProgramClock::create();
  if (!clock) {
    status.clock = ProcessClock::RealNoLibrary;
    entry.warnedOfRealTime = false;
    return;
  }
  entry.clock = std::move(*clock);
  entry.matchStart.reset();
  status.clock = ProcessClock::Match;
  for (auto& variable : entry.clock->start(m_paused ? 0.0 : m_speed, now)) {
    spec.environment.push_back(std::move(variable));
  }
}

/// A program that runs is to keep this speed from now on.
void ProcessManager::askForSpeed(Entry& entry, Time now) {
  if (!entry.process.spec.isTeamProgram) return;
  ProcessStatus& status = entry.status;
  // The speed that a match reaches is never quite the same.
  constexpr double alike = 0.05;
  const bool same = std::abs(m_speed - status.speed) < alike * m_speed;
  status.speed = m_speed;
  changed();
  if (!entry.clock) {
    status.achieved = m_speed > 1.0 ? 1.0 : 0.0;  // of clocks that keep real time it is known
  } else if (!same) {
    status.achieved = 0.0;   // it has to be seen
    entry.cpuSeconds = 0.0;  // no second that is not half of this speed
    entry.sampled = now;
  }
  if (entry.clock || m_speed == 1.0 || std::exchange(entry.warnedOfRealTime, true)) return;
  addNews(entry, ProcessNewsKind::RealTime, whyRealTime(status.clock));
}

void ProcessManager::setPaused(bool paused, Time now) {
  if (m_paused == paused) return;
  m_paused = paused;
  bool follows = false;
  // Their time stops before they are stopped, and continues before they continue.
  for (Entry& entry : m_entries) {
    if (!entry.child || !entry.clock) continue;
    entry.clock->setRate(paused ? 0.0 : m_speed, now);
    follows = true;
  }
  // A program that is stopped cannot set its timers again; this is the time that it has for it.
  constexpr std::chrono::milliseconds forTimers{5};
  if (paused && follows) std::this_thread::sleep_for(forTimers);
  for (Entry& entry : m_entries) {
    if (!entry.child || !entry.process.spec.isTeamProgram) continue;
    entry.child->signal(paused ? SIGSTOP : SIGCONT);
    entry.lastSign = entry.stoppedSince = now;
  }
}

void ProcessManager::setTime(double matchSeconds, double speed, Time now) {
  m_matchSeconds = matchSeconds;
  const bool faster = std::exchange(m_speed, speed) != speed;
  for (Entry& entry : m_entries) {
    if (!entry.child || !entry.process.spec.isTeamProgram) continue;
    if (faster) askForSpeed(entry, now);
    if (entry.clock && !m_paused) steer(entry, now);
  }
}

/// Lets its clock go at the match's speed, and a little faster or slower where it is not at the
/// match's time. A new rate disturbs the waits of the program, so it is set only when it matters,
/// and then stays until the program is at the match's time: a match is late now and then and never
/// early, so that half a correction would leave its programs ahead of it for good.
void ProcessManager::steer(Entry& entry, Time now) const {
  constexpr double maxJump = 1.0;  // s at ×1: farther off, the match stood or jumped
  constexpr double alike = 0.01;
  constexpr double maxKept = 0.1;  // of a correction; more is the rate of another speed
  const double own = entry.clock->seconds(now);
  double behind = m_matchSeconds - entry.matchStart.value_or(m_matchSeconds - own) - own;
  if (!entry.matchStart || std::abs(behind) > maxJump * std::max(1.0, m_speed)) {
    entry.matchStart = m_matchSeconds - own;
    behind = 0.0;
  }
  const double rate = ProgramClock::rateFor(behind, m_speed);
  const double before = entry.clock->rate();
  const double corrects = before - m_speed;
  if (rate == m_speed && corrects * behind > 0.0 && std::abs(corrects) < maxKept * m_speed) return;
  const bool worthIt = rate == m_speed || std::abs(rate - before) > alike * m_speed;
  if (rate != before && worthIt) entry.clock->setRate(rate, now);
}

/// The program's own time since it was started, s.
double ProcessManager::ownSeconds(const Entry& entry, Time now) {
  return entry.clock ? entry.clock->seconds(now)
                     : RestartRule::Seconds(now - entry.status.started).count();
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
  entry.warnedOfRealTime = false;
  askForSpeed(entry, now);
}

bool ProcessManager::hasSegment(int id, int shmid) const {
  const Entry* entry = const_cast<ProcessManager*>(this)->find(id);
  return entry && entry->child && std::ranges::any_of(entry->child->all(), [shmid](pid_t pid) {
           return mapsSegment(pid, shmid);
         });
}

}  // namespace pitchboard::link
