// SPDX-License-Identifier: GPL-3.0-or-later
// A match that is played as fast as possible waits for a team's programs to attach.
#include <algorithm>

#include <robotlink/match/simulated_match.h>

#include "match_events.h"
#include "match_seat.h"

namespace pitchboard::link {

using Seconds = RestartRule::Seconds;

bool SimulatedMatch::awaitsPrograms(std::chrono::steady_clock::time_point now) {
  bool awaits = false;
  for (const auto& seat : m_seats) {
    for (const auto& process : seat->processes) {
      const bool program = !process->inside && !process->profile.isReference();
      if (program && !process->settled) awaits = isAwaited(*seat, *process, now) || awaits;
    }
  }
  if (awaits) {
    m_processes->setSpeed(1.0, now);
    // How fast it is played is measured from here on.
    m_measured = now;
    m_measuredTick = m_simulation.state().tick;
  }
  return awaits;
}

bool SimulatedMatch::isAwaited(const Seat& seat, SeatProcess& process,
                               std::chrono::steady_clock::time_point now) {
  constexpr Seconds leastPatience{10.0};
  constexpr int mostRestarts = 2;  // of a program that ends at once
  const ProcessStatus* status = m_processes->status(process.id);
  process.settled = !status || status->state == ProcessState::Stopped || hasAttached(*status);
  if (process.settled) return false;
  if (status->state == ProcessState::Waiting) return true;  // for the one before it
  if (!process.awaitedSince) process.awaitedSince = now;
  const Seconds waited = now - *process.awaitedSince;
  const bool isLost = status->restarts >= mostRestarts || status->state == ProcessState::Ended ||
                      status->state == ProcessState::GivenUp;
  if (!isLost && waited < std::max(leastPatience, Seconds(process.profile.silentAfter))) {
    return true;
  }
  process.settled = true;
  m_events->notAttached(m_simulation.state(), seat.id, process.profile.name,
                        "after " + inSeconds(waited) + "; the match " +
                            (process.startTick == 0 ? "starts" : "goes on") + " without it");
  return false;
}

bool SimulatedMatch::hasAttached(const ProcessStatus& program) const {
  const Blackboard* board = blackboard(program.robot);
  if (program.state != ProcessState::Running || !board) return false;
  const auto segment = SystemVSegments::info(board->key());
  // The match is the first to have it.
  return segment && segment->attached > 1 && m_processes->hasSegment(program.id, segment->shmid);
}

}  // namespace pitchboard::link
