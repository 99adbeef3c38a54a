// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the reference robots of a team tell each other through their blackboards: the decision
// process writes its own part, the team process sends it and writes what the others sent. All of it
// lies in published variables. Places are whole cm of the LOCALIZATION frame; a place packed into
// one int is x * 10000 + y, readable in the inspector (4500300 = x 450, y 300), and -1 is unknown.
//
// The published map has room for three team-mates with all that they tell (COM_*_ROBOT1..3), and
// for the places of ten, a team of eleven (LOCALIZATION_RBT02_X to _RBT11_Y; _RBT01_X is the
// belief), and of eleven opponents (LOCALIZATION_OPP01_X to _OPP11_Y), which decision remembers.

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include <robotlink/blackboard/robot_variables.h>
#include <robotlink/cognition/soccer_input.h>

namespace pitchboard::link {

constexpr int maxMatePlaces = 10;  // LOCALIZATION_RBT02_X .. _RBT11_Y
constexpr int maxOpponents = 11;   // LOCALIZATION_OPP01_X .. _OPP11_Y

/// COM_STATE_ROBOTn.
enum class MateState : int { Unknown = 0, Active = 1, Down = 2 };

struct TeamVariables {
  /// Those of the published map.
  TeamVariables();

  IntVar intention;         ///< Intention
  IntVar targetX, targetY;  ///< cm, where the robot is walking to
  FloatVar ballX, ballY;    ///< cm, the ball as this robot saw it itself; -1 = not lately
  std::array<IntVar, maxTeamMates> state, action, place, ball;
  std::array<FloatVar, maxMatePlaces> mateX, mateY;  ///< cm, every team-mate; -1 = none
  /// cm, opponents as this robot saw them itself; -1 = none
  std::array<FloatVar, maxOpponents> opponentX, opponentY;

 private:
  struct LookedUp {};
  explicit TeamVariables(LookedUp look);
};

constexpr int packPlace(int x_cm, int y_cm) {
  return std::clamp(x_cm, 0, 9999) * 10000 + std::clamp(y_cm, 0, 9999);
}

struct PlaceCm {
  int x = 0, y = 0;
};
constexpr std::optional<PlaceCm> unpackPlace(int packed) {
  if (packed < 0 || packed > 99999999) return std::nullopt;
  return PlaceCm{packed / 10000, packed % 10000};
}

}  // namespace pitchboard::link
