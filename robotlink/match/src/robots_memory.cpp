// SPDX-License-Identifier: GPL-3.0-or-later
// What the processes inside a match remember: taken, given back, and played through what came after
// it, up to a moment.
#include <robotlink/match/robots_memory.h>

#include <algorithm>
#include <bit>
#include <utility>

#include <robotlink/match/moment.h>
#include <robotlink/match/simulated_match.h>

#include "match_referee.h"
#include "match_seat.h"

namespace pitchboard::link {

std::shared_ptr<const RobotsMemory> SimulatedMatch::robotsMemory() const {
  if (m_options.cognition != Cognition::Inline) return nullptr;
  auto all = std::make_shared<RobotsMemory>();
  all->tick = m_simulation.state().tick;
  all->referee = m_referee->rhythm();
  for (std::size_t i = 0; i < m_teamChannels.size(); ++i) {
    if (m_teamChannels[i]) all->channels[i] = *m_teamChannels[i];
  }
  for (const auto& seat : m_seats) {
    RobotsMemory::Robot& robot = all->robots.emplace_back();
    robot.id = seat->id;
    robot.behaviour = seat->behaviour;
    robot.orders = seat->orders;
    seat->board.copyWords(robot.board);
    all->bytes += sizeof robot;
    for (const auto& process : seat->processes) {
      if (!process->inside) continue;
      robot.processes.push_back({process->profile.name, process->inside->remembered()});
      all->bytes += process->inside->memoryBytes();
    }
  }
  return all;
}

/// The processes inside begin with what stands on their blackboards.
void SimulatedMatch::startAnew() {
  for (const auto& channel : m_teamChannels) {
    if (channel) channel->clear();
  }
  for (const auto& seat : m_seats) {
    seat->orders = {};
    for (const auto& process : seat->processes) {
      if (!process->inside) continue;
      seat->facesLeft = identityOf(seat->id).imuStartsAt180;
      process->startTick = m_simulation.state().tick;
      if (startInside(*seat, *process)) process->inside->resume(seat->board);
    }
  }
}

void SimulatedMatch::recall(const RobotsMemory& memory) {
  m_referee->setRhythm(memory.referee);
  for (std::size_t i = 0; i < m_teamChannels.size(); ++i) {
    if (m_teamChannels[i]) *m_teamChannels[i] = memory.channels[i];
  }
  for (const RobotsMemory::Robot& robot : memory.robots) {
    Seat* known = seat(robot.id);
    if (!known) continue;
    known->orders = robot.orders;
    for (int word = 0; word < Blackboard::words; ++word) {
      const std::uint32_t bits = robot.board[static_cast<std::size_t>(word)];
      known->board.write(IntVar{word}, std::bit_cast<std::int32_t>(bits));
    }
    for (const auto& process : known->processes) {
      if (!process->inside) continue;
      const auto found =
          std::find_if(robot.processes.begin(), robot.processes.end(),
                       [&](const auto& one) { return one.name == process->profile.name; });
      if (found != robot.processes.end() && found->memory) {
        (void)process->inside->recall(*found->memory);
      }
    }
  }
}

/// The world goes as it went, whatever the processes say now: changes by hand, other programs and a
/// GameController are in the states and commands. Ends at the moment to which this is the past.
void SimulatedMatch::playThrough(const MomentPast& past) {
  const auto sameRobots = [&](const PlayedStretch& stretch) {
    return std::ranges::equal(stretch.from.robots, m_seats, [](const auto& robot, const auto& one) {
      return robot.id == one->id;
    });
  };
  if (!std::ranges::all_of(past.played, sameRobots)) return;
  bool begun = false;
  for (const PlayedStretch& stretch : past.played) {
    if (!m_simulation.restore(stretch.from)) return;
    m_scenario.settings = stretch.from.settings;
    followJump();
    if (!std::exchange(begun, true)) {
      startAnew();
      recall(*past.memory);
    }
    for (const std::vector<sim::RobotCommand>& told : stretch.commands) {
      applyDueWrites();
      m_commands = told;
      advance(true);
    }
  }
  if (!begun) recall(*past.memory);
}

}  // namespace pitchboard::link
