// SPDX-License-Identifier: GPL-3.0-or-later
// A recorded moment is put back, and what the processes inside a match remember: taken, given back,
// and played through what came after it, up to a moment.
#include <robotlink/match/robots_memory.h>

#include <algorithm>
#include <bit>
#include <utility>

#include <base/try.h>
#include <robotlink/match/moment.h>

#include "match_parts.h"

namespace pitchboard::link {

std::shared_ptr<const RobotsMemory> SimulatedMatch::robotsMemory() const {
  if (m_parts->base.options.cognition != Cognition::Inline) return nullptr;
  auto all = std::make_shared<RobotsMemory>();
  all->tick = m_parts->base.tick();
  all->referee = m_parts->referee.rhythm();
  const auto& channels = m_parts->slots.teamChannels();
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (channels[i]) all->channels[i] = *channels[i];
  }
  for (const auto& slot : robots().all()) {
    RobotsMemory::Robot& robot = all->robots.emplace_back();
    robot.id = slot->id;
    robot.behaviour = slot->behaviour;
    robot.orders = slot->orders;
    slot->board.copyWords(robot.board);
    all->bytes += sizeof robot;
    for (const auto& process : slot->processes) {
      if (!process->inside) continue;
      robot.processes.push_back({process->profile.name, process->inside->remembered()});
      all->bytes += process->inside->memoryBytes();
    }
  }
  return all;
}

Result<void> SimulatedMatch::restore(const Moment& moment) {
  return m_parts->restore(moment);
}

Result<void> SimulatedMatch::Parts::restore(const Moment& moment) {
  if (moment.state.settings.tickRate != base.tickRate()) {
    return failure(ErrorCode::InvalidArgument,
                   "this moment was played at another tick rate than this match; start a match of "
                   "its own scenario");
  }
  // Everything that can fail comes before anything of the present match is given up.
  TRY(slots.become(moment));
  following.begin(nullptr);
  base.commands.assign(slots.all().size(), {});
  base.scenario.settings = moment.state.settings;
  const auto writeBoards = [&] {
    for (const auto& slot : slots.all()) {
      if (const MomentRobot* known = moment.robot(slot->id)) known->writeTo(slot->board);
    }
  };
  writeBoards();
  startAnew();
  if (moment.past && moment.past->memory) {
    playThrough(*moment.past);
    (void)base.simulation.restore(moment.state);
    base.scenario.settings = moment.state.settings;
    writeBoards();
  }
  followJump();
  expectedTick = moment.state.tick;
  return {};
}

/// The processes inside begin with what stands on their blackboards.
void SimulatedMatch::Parts::startAnew() {
  for (const auto& channel : slots.teamChannels()) {
    if (channel) channel->clear();
  }
  for (const auto& slot : slots.all()) {
    slot->orders = {};
    startAnew(*slot);
  }
}

void SimulatedMatch::Parts::startAnew(RobotSlot& slot) {
  for (const auto& process : slot.processes) {
    if (!process->inside) continue;
    slot.facesLeft = slots.identityOf(slot.id).imuStartsAt180;
    process->startTick = base.simulation.state().tick;
    if (slots.startInside(slot, *process)) process->inside->resume(slot.board);
  }
}

void SimulatedMatch::Parts::restore(const RobotsMemory& memory) {
  referee.setRhythm(memory.referee);
  for (std::size_t i = 0; i < slots.teamChannels().size(); ++i) {
    if (slots.teamChannels()[i]) *slots.teamChannels()[i] = memory.channels[i];
  }
  for (const RobotsMemory::Robot& robot : memory.robots) {
    RobotSlot* known = slots.find(robot.id);
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
        (void)process->inside->restore(*found->memory);
      }
    }
  }
}

/// The world goes as it went, whatever the processes say now: changes by hand, other programs and a
/// GameController are in the states and commands. Ends at the moment to which this is the past.
void SimulatedMatch::Parts::playThrough(const MomentPast& past) {
  const auto sameRobots = [&](const PlayedStretch& stretch) {
    return std::ranges::equal(
        stretch.from.robots, slots.all(),
        [](const auto& robot, const auto& one) { return robot.id == one->id; });
  };
  if (!std::ranges::all_of(past.played, sameRobots)) return;
  bool begun = false;
  for (const PlayedStretch& stretch : past.played) {
    if (!base.simulation.restore(stretch.from)) return;
    base.scenario.settings = stretch.from.settings;
    followJump();
    if (!std::exchange(begun, true)) {
      startAnew();
      restore(*past.memory);
    }
    for (const std::vector<sim::RobotCommand>& commands : stretch.commands) {
      base.writes.applyDue(base.tick(), slots);
      base.commands = commands;
      advance(true);
    }
  }
  if (!begun) restore(*past.memory);
}

}  // namespace pitchboard::link
