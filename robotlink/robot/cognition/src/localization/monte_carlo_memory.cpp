// SPDX-License-Identifier: GPL-3.0-or-later
// A filter that is kept for later: without the memory that it only needs while it works.
#include "localization/monte_carlo_localization.h"

namespace pitchboard::link {

void MonteCarloLocalization::expand() {
  const auto cells = static_cast<std::size_t>(m_columns) * static_cast<std::size_t>(m_rows);
  m_cellStamp.resize(cells * headingCells, 0);
  m_cellWeight.resize(cells, 0.0F);
  const int room = particles::capacityFor(m_parameters.maxParticles);
  const auto grow = [room](Array& array) {
    const auto had = array.size();
    array.conservativeResize(room);
    array.tail(room - had).setZero();
  };
  for (Particles* set : {&m_now, &m_next}) {
    for (Array* a : {&set->x, &set->y, &set->c, &set->s}) grow(*a);
  }
  for (Array* a : {&m_weight, &m_a, &m_b, &m_d}) grow(*a);
  m_cells.resize(static_cast<std::size_t>(room));
}

MonteCarloLocalization MonteCarloLocalization::compact() const {
  MonteCarloLocalization kept = *this;
  const int room = particles::capacityFor(m_count);
  for (Array* a : {&kept.m_now.x, &kept.m_now.y, &kept.m_now.c, &kept.m_now.s, &kept.m_weight}) {
    a->conservativeResize(room);
  }
  kept.m_next = {};
  for (Array* a : {&kept.m_a, &kept.m_b, &kept.m_d}) a->resize(0);
  kept.m_cells = {};
  kept.m_cellStamp = {};
  kept.m_cellWeight = {};
  return kept;
}

std::size_t MonteCarloLocalization::compactBytes() const {
  constexpr std::size_t arrays = 5;  // place, heading, weight
  return arrays * sizeof(float) * static_cast<std::size_t>(particles::capacityFor(m_count));
}

}  // namespace pitchboard::link
