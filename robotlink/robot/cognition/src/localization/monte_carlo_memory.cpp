// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "localization/monte_carlo_localization.h"

namespace pitchboard::link {

MonteCarloLocalization::Scratch& MonteCarloLocalization::scratch() const {
  thread_local Scratch all;
  const int room = particles::capacityFor(m_parameters.maxParticles);
  if (all.a.size() < room) {
    for (Array* a : {&all.a, &all.b, &all.d, &all.next.x, &all.next.y, &all.next.c, &all.next.s}) {
      a->setZero(room);
    }
    all.cells.resize(static_cast<std::size_t>(room));
  }
  const auto cells = static_cast<std::size_t>(m_columns) * static_cast<std::size_t>(m_rows);
  if (all.cellWeight.size() < cells) {
    all.cellStamp.resize(cells * headingCells, 0);
    all.cellWeight.resize(cells, 0.0F);
  }
  return all;
}

void MonteCarloLocalization::makeRoom(int count) {
  constexpr int hysteresis = 4;
  const int room = particles::capacityFor(count);
  const auto had = static_cast<int>(m_weight.size());
  if (had >= room && had <= hysteresis * room) return;
  for (Array* a : {&m_now.x, &m_now.y, &m_now.c, &m_now.s, &m_weight}) {
    a->conservativeResize(room);
    if (room > had) a->tail(room - had).setZero();
  }
}

MonteCarloLocalization MonteCarloLocalization::compact() const {
  MonteCarloLocalization kept = *this;
  for (Array* a : {&kept.m_now.x, &kept.m_now.y, &kept.m_now.c, &kept.m_now.s, &kept.m_weight}) {
    a->conservativeResize(particles::capacityFor(m_count));
  }
  return kept;
}

std::size_t MonteCarloLocalization::compactBytes() const {
  constexpr std::size_t arrays = 5;  // place, heading, weight
  return arrays * sizeof(float) * static_cast<std::size_t>(particles::capacityFor(m_count));
}

}  // namespace pitchboard::link
