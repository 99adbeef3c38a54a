// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The moment that a match is at, with everything its robots' processes remember, for tests that
// restore it. The test's thread.

#include <memory>
#include <utility>

#include <robotlink/match/moment.h>
#include <robotlink/match/robots_memory.h>
#include <robotlink/match/simulated_match.h>

namespace pitchboard::link {

inline Moment momentOf(const SimulatedMatch& match) {
  auto past = std::make_shared<MomentPast>();
  past->memory = match.robotsMemory();
  Moment moment;
  moment.state = match.simulation().state();
  for (const RobotsMemory::Robot& robot : past->memory->robots) {
    MomentRobot& known = moment.robots.emplace_back();
    known.id = robot.id;
    known.behaviour = robot.behaviour;
    for (int word = 0; word < Blackboard::words; ++word) {
      known.words.push_back({word, robot.board[static_cast<std::size_t>(word)]});
    }
  }
  moment.past = std::move(past);
  return moment;
}

}  // namespace pitchboard::link
