// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One robot's place in a simulated match: its blackboard and what runs on it. Private to robotlink.

#include <chrono>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <robotlink/cognition/referee_orders.h>
#include <robotlink/match/simulated_match.h>

namespace pitchboard::link {

/// A process of a robot: inside this program, or separate.
struct SeatProcess {
  ProfileProcess profile;
  std::unique_ptr<CognitiveProcess> inside;  ///< nothing: it is separate
  int id = 0;                                ///< of a separate one, in the manager
  bool known = false;                        ///< how often it wants a turn is known
  double period = 0.0;                       ///< s, once known
  std::uint64_t startTick = 0;               ///< after which it was started
  std::uint64_t nextTick = 0;                ///< runs after the tick that ends here

  // Of a team's program: see SimulatedMatch::awaitsPrograms().
  bool settled = false;  ///< it is not waited for any more
  std::optional<std::chrono::steady_clock::time_point> awaitedSince{};

  // Of a separate one that takes turns (a reference process).
  int place = -1;      ///< its place in the turns; below 0: it has not been started
  bool given = false;  ///< it has been given the turn of this tick
  std::chrono::steady_clock::time_point givenAt{};

  bool takesTurns() const { return !inside && profile.isReference(); }
};

struct SimulatedMatch::Seat {
  RobotId id;
  std::string behaviour;
  BehaviourParameters parameters;    ///< of its behaviour
  RuntimeChoice choice;              ///< as told for this robot; may be nothing
  RuntimeProfile runtime;            ///< what that means
  bool extended = false;             // its decision knows the extension of the map
  bool facesLeft = false;            // what its processes were told
  std::optional<BridgeClaim> claim;  // given back after the segment is gone
  Blackboard board;
  RefereeOrders orders;
  std::vector<std::unique_ptr<SeatProcess>> processes;
  std::size_t turn = 0;  ///< of `processes`, within a tick

  /// One tick of all separate reference processes, in lock-step.
  static void takeTurns(SimulatedMatch& match);
  /// Its turn, ahead of waiting for it.
  void giveIfReady(SimulatedMatch& match, SeatProcess& process);

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
