// SPDX-License-Identifier: GPL-3.0-or-later
#include "own_programs.h"

#include <algorithm>
#include <thread>

#include <robotlink/blackboard/system_v.h>
#include <robotlink/match/own_pace.h>

namespace pitchboard::link {
namespace {

using namespace std::chrono_literals;
constexpr auto lookInterval = 50ms;
constexpr auto glance = 5ms;        // between two looks whether the programs are there
constexpr auto mostPatience = 10s;  // for programs that never attach a blackboard
constexpr int mostRestarts = 2;     // of a program that ends at once

}  // namespace

Result<bool> hasOwnPrograms(const Scenario& scenario) {
  for (const ScenarioRobot& robot : scenario.robots) {
    const RuntimeChoice choice = scenario.runtimeOf(robot);
    if (!choice.isChosen()) continue;
    const auto runtime = loadRuntime(choice);
    if (!runtime) return tl::unexpected(runtime.error());
    const auto& all = runtime->processes;
    if (std::any_of(all.begin(), all.end(), [](const auto& p) { return !p.isReference(); })) {
      return true;
    }
  }
  return false;
}

/// It has attached the blackboard of its robot; the match is the first to have it.
bool OwnPrograms::isThere(const ProcessStatus& program) const {
  if (!program.foreign) return true;
  const Blackboard* board = m_player.match().blackboard(program.robot);
  if (program.state != ProcessState::Running || !board) return false;
  const auto segment = SystemVSegments::info(board->key());
  return segment && segment->attached > 1;
}

/// Or one of them will never be.
bool OwnPrograms::areThere() const {
  const auto& all = m_player.match().processes().statuses();
  const auto isLost = [](const ProcessStatus& one) {
    return one.foreign && (one.restarts >= mostRestarts || one.state == ProcessState::Ended ||
                           one.state == ProcessState::GivenUp);
  };
  return std::any_of(all.begin(), all.end(), isLost) ||
         std::all_of(all.begin(), all.end(),
                     [this](const ProcessStatus& one) { return isThere(one); });
}

Result<void> OwnPrograms::missing() const {
  for (const ProcessStatus& one : m_player.match().processes().statuses()) {
    // One that runs and attaches nothing may have another way to see its robot.
    if (isThere(one) || (one.state == ProcessState::Running && one.restarts == 0)) continue;
    const auto index = m_player.match().simulation().indexOf(one.robot);
    const std::string robot =
        index ? m_player.match().simulation().state().robots[*index].name() : std::string();
    return failure(ErrorCode::NotFound,
                   robot + ' ' + one.name + " does not run: " + one.detail +
                       (one.lastLines.empty() ? "" : "; its last words: " + one.lastLines.back()));
  }
  return {};
}

Result<void> OwnPrograms::begin(const std::atomic<bool>* cancelled) {
  SimulatedMatch& match = m_player.match();
  // What they see first is a moment of the match, not an empty blackboard.
  match.setPlaying(m_speed, true, Clock::now());
  m_player.tick();
  match.setPlaying(m_speed, false, Clock::now());
  match.slowTo(1.0, Clock::now());
  const auto latest = Clock::now() + mostPatience;
  while (!areThere() && Clock::now() < latest) {
    if (cancelled && *cancelled) return {};
    match.lookAfterProcesses(Clock::now());
    std::this_thread::sleep_for(glance);
  }
  if (auto here = missing(); !here) return here;
  m_looked = m_followed = Clock::now();
  setSpeed(match.ownPace(m_speed, m_speed), m_looked);
  return {};
}

void OwnPrograms::setSpeed(double speed, Clock::time_point now) {
  m_now = speed;
  SimulatedMatch& match = m_player.match();
  match.slowTo(speed, now);
  m_pacer.start(now, m_player.currentTick(), speed * match.simulation().state().settings.tickRate);
}

void OwnPrograms::look(Clock::time_point now) {
  SimulatedMatch& match = m_player.match();
  m_looked = now;
  match.lookAfterProcesses(now);
  (void)match.processes().takeLines();
  const auto slowest = match.slowestOwnProgram();
  m_kept += slowest ? std::min(1.0, *slowest / m_now) : 1.0;
  m_looks += 1.0;
  if (now - m_followed < ownPaceInterval) return;
  m_followed = now;
  const double speed = match.ownPace(m_speed, m_now);
  if (speed != m_now) setSpeed(speed, now);
}

void OwnPrograms::wait() {
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
