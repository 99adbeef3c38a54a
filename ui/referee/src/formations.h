// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Formations and set plays that can be loaded onto a running match: where the robots of two teams
// and the ball stand. Pure; metres, the studio's frame.

#include <optional>
#include <string>
#include <vector>

#include <robotlink/frame/match_frame.h>
#include <simcore/world/game_state.h>

namespace pitchboard::ui {

struct Formation {
  const char* name;     ///< as in the list
  const char* meaning;  ///< its tip
};

/// Every formation, in the order of the list.
const std::vector<Formation>& formations();

struct FormationPlaces {
  Point ball;
  std::vector<std::pair<RobotId, Pose>> robots;  ///< of the two teams that play
  sim::SetPlay setPlay = sim::SetPlay::None;     ///< that begins like this
  TeamColor attackers = TeamColor::Blue;         ///< who has the ball
};

/// `leftAttacks`: the team that defends the left goal has the ball. `index` of formations().
FormationPlaces placesOf(std::size_t index, const link::MatchFrame& frame, bool leftAttacks);

}  // namespace pitchboard::ui
