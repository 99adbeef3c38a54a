// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One robot's place in a simulated match: its blackboard and what runs on it. Private to robotlink.

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <robotlink/match/simulated_match.h>

namespace pitchboard::link {

struct InlineProcess {
  const ProcessInfo* info = nullptr;
  std::unique_ptr<CognitiveProcess> process;
  std::uint64_t nextTick = 0;  ///< runs after the tick that ends here
};

struct SimulatedMatch::Seat {
  RobotId id;
  std::string behaviour;
  bool facesLeft = false;             // what its processes were told
  std::optional<BridgeClaim> claim;  // given back after the segment is gone
  Blackboard board;
  std::vector<InlineProcess> processes;

  explicit Seat(Blackboard memory) : board(std::move(memory)) {}

  void write(const std::variant<IntVar, FloatVar>& variable, double value) {
    if (const auto* whole = std::get_if<IntVar>(&variable)) {
      board.write(*whole, static_cast<int>(value));
    } else {
      board.write(std::get<FloatVar>(variable), static_cast<float>(value));
    }
  }
};

}  // namespace pitchboard::link
