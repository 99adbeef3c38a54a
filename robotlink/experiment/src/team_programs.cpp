// SPDX-License-Identifier: GPL-3.0-or-later
#include "team_programs.h"

#include <algorithm>
#include <thread>

#include <base/try.h>

namespace pitchboard::link {
namespace {

using namespace std::chrono_literals;
constexpr auto lookInterval = 50ms;
constexpr auto glance = 20ms;  // between two looks whether the programs are there

}  // namespace

Result<void> TeamPrograms::missing() const {
  const SimulatedMatch& match = m_player.match();
  for (const ProcessStatus& one : match.robots().processes().statuses()) {
    // One that runs and attaches nothing may have another way to see its robot.
    if (!one.isTeamProgram || (one.state == ProcessState::Running && one.restarts == 0) ||
        match.pace().hasAttached(one)) {
      continue;
    }
    const auto index = match.simulation().indexOf(one.robot);
    const std::string robot =
        index ? match.simulation().state().robots[*index].name() : std::string();
    return failure(ErrorCode::NotFound,
                   robot + ' ' + one.name + " does not run: " + one.detail +
                       (one.lastLines.empty() ? "" : "; last output: " + one.lastLines.back()));
  }
  return {};
}

Result<void> TeamPrograms::begin(const std::atomic<bool>* cancelled) {
  SimulatedMatch& match = m_player.match();
  match.pace().setPlaying(m_speed, false, Clock::now());
  while (m_player.awaitPrograms(Clock::now())) {
    if (cancelled && *cancelled) return {};
    m_player.lookAfterProcesses(Clock::now());
    std::this_thread::sleep_for(glance);
  }
  TRY(missing());
  m_looked = m_followed = Clock::now();
  setSpeed(match.pace().teamProgramPace(m_speed, m_speed), m_looked);
  return {};
}

void TeamPrograms::setSpeed(double speed, Clock::time_point now) {
  m_now = speed;
  SimulatedMatch& match = m_player.match();
  match.pace().slowTo(speed, now);
  m_pacer.start(now, m_player.currentTick(), speed * match.simulation().state().settings.tickRate);
}

void TeamPrograms::look(Clock::time_point now) {
  SimulatedMatch& match = m_player.match();
  m_looked = now;
  m_player.lookAfterProcesses(now);
  const auto slowest = match.pace().slowestTeamProgram();
  m_kept += slowest ? std::min(1.0, *slowest / m_now) : 1.0;
  m_looks += 1.0;
  if (now - m_followed < ProcessPace::paceInterval) return;
  m_followed = now;
  const double speed = match.pace().teamProgramPace(m_speed, m_now);
  if (speed != m_now) setSpeed(speed, now);
}

void TeamPrograms::wait() {
  auto now = Clock::now();
  while (m_pacer.target(now) <= m_player.currentTick()) {
    if (now - m_looked >= lookInterval) look(now);
    std::this_thread::sleep_until(m_pacer.wake(now, m_player.currentTick()));
    now = Clock::now();
  }
  if (now - m_looked >= lookInterval) look(now);
  m_pacer.forgive(now, m_player.currentTick());
}

}  // namespace pitchboard::link
