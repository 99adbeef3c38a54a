// SPDX-License-Identifier: GPL-3.0-or-later
#include "planning/known_robots.h"

#include <simcore/world/published_frame.h>

namespace pitchboard::link {
namespace {

Point fromCm(const sim::FieldSpec& field, double x, double y) {
  return sim::published_frame::studioFromLocalization(field, {x, y, 0.0}).position;
}

template <std::size_t Count>
void readPlaces(const Blackboard& board, const sim::FieldSpec& field,
                const std::array<FloatVar, Count>& xs, const std::array<FloatVar, Count>& ys,
                Points& places) {
  for (std::size_t i = 0; i < Count; ++i) {
    const double x = static_cast<double>(readOr(board, xs[i], -1.0F));
    const double y = static_cast<double>(readOr(board, ys[i], -1.0F));
    // Zeros are fresh memory: nobody stands on the corner.
    if (x >= 0.0 && y >= 0.0 && x + y > 0.0 && x < 1e5 && y < 1e5)
      places.push_back(fromCm(field, x, y));
  }
}

}  // namespace

void KnownRobots::read(const Blackboard& board, const sim::FieldSpec& field, Points& places) const {
  places.clear();
  readPlaces(board, field, m_team.mateX, m_team.mateY, places);
  if (places.empty()) {  // another team's process writes these only
    for (std::size_t i = 0; i < m_team.place.size(); ++i) {
      const auto place = unpackPlace(readOr(board, m_team.place[i], -1));
      if (place && readOr(board, m_team.state[i]) != static_cast<int>(MateState::Unknown))
        places.push_back(fromCm(field, place->x, place->y));
    }
  }
  readPlaces(board, field, m_team.opponentX, m_team.opponentY, places);
}

}  // namespace pitchboard::link
