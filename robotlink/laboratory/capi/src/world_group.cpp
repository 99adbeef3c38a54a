// SPDX-License-Identifier: GPL-3.0-or-later
#include "world_group.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace pitchboard::link {

WorldGroup::WorldGroup() {
  std::iota(m_places.begin(), m_places.end(), 0);
}

std::vector<Variable> WorldGroup::placed(std::span<const Variable> variables) const {
  std::vector<Variable> out(variables.begin(), variables.end());
  for (Variable& variable : out) {
    variable.index = variable.type == VariableType::Int ? placed(IntVar{variable.index}).index
                                                        : placed(FloatVar{variable.index}).index;
  }
  return out;
}

MomentRobot WorldGroup::saved(RobotId id, const std::string& behaviour,
                              const Blackboard& board) const {
  MomentRobot robot{id, behaviour, {}};
  robot.words.reserve(Blackboard::words);
  for (int word = 0; word < Blackboard::words; ++word) {
    const int bits = board.read(placed(IntVar{word}));
    robot.words.push_back({word, std::bit_cast<std::uint32_t>(bits)});
  }
  return robot;
}

Result<void> WorldGroup::checkSnapshot(const WorldSnapshot& snapshot, const sim::WorldState& mine) {
  const sim::WorldState& theirs = snapshot.moment.state;
  sim::SimulationSettings settings = theirs.settings;
  settings.seed = mine.settings.seed;
  if (settings == mine.settings && theirs.models == mine.models &&
      std::ranges::equal(theirs.robots, mine.robots, {}, &sim::RobotIdentity::id,
                         &sim::RobotIdentity::id)) {
    return {};
  }
  return failure(ErrorCode::InvalidArgument,
                 "this snapshot is of a world of another scenario; restore it into worlds of its "
                 "own");
}

}  // namespace pitchboard::link
