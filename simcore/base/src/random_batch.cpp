// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/random_batch.h>

#include "normal_quantile.h"
#include "random_loops.h"

namespace pitchboard {

double RandomBatch::Sequence::uniform() {
  ++m_normals;
  return *m_wholes++ * 0x1.0p-53;
}

double RandomBatch::Sequence::normal(double mean, double sigma) {
  if (sigma == 0.0) return mean;
  const double p = random_loops::inside(*m_wholes++), q = p - 0.5;
  const double middle = *m_normals++;
  return mean + sigma * (quantile::isMiddle(q) ? middle : quantile::away(p, q));
}

void RandomBatch::make(std::span<const Tick> ticks, NoiseStream stream, std::span<const int> robots,
                       int count) {
  const auto blocks = (static_cast<std::size_t>(count) + 1) / 2;
  const std::size_t counters = ticks.size() * robots.size() * blocks;
  m_stride = 2 * blocks;
  if (m_high.size() < counters) {
    for (auto* words : {&m_seedLow, &m_seedHigh, &m_tickLow, &m_high, &m_robot}) {
      words->resize(counters);
    }
    m_wholes.resize(2 * counters);
    m_normals.resize(2 * counters);
  }
  std::size_t k = 0;
  for (const Tick& one : ticks) {
    // As CounterRandom counts.
    const std::uint32_t high = static_cast<std::uint32_t>(one.tick >> 32) << 16;
    for (const int robot : robots) {
      for (std::size_t block = 0; block < blocks; ++block, ++k) {
        m_seedLow[k] = static_cast<std::uint32_t>(one.seed);
        m_seedHigh[k] = static_cast<std::uint32_t>(one.seed >> 32);
        m_tickLow[k] = static_cast<std::uint32_t>(one.tick);
        m_high[k] = high + static_cast<std::uint32_t>(block);
        m_robot[k] = static_cast<std::uint32_t>(robot);
      }
    }
  }
  random_loops::loops().fillWholes(
      {m_seedLow.data(), m_seedHigh.data(), m_tickLow.data(), m_high.data(), m_robot.data(),
       static_cast<std::uint32_t>(stream)},
      m_wholes.data(), counters);
  random_loops::loops().fillNormals(m_wholes.data(), m_normals.data(), 2 * counters);
}

}  // namespace pitchboard
