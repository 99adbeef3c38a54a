// SPDX-License-Identifier: GPL-3.0-or-later
#include <Random123/philox.h>

#include <base/random.h>
#include "normal_quantile.h"

namespace pitchboard {
CounterRandom::CounterRandom(std::uint64_t seed, int robot, NoiseStream stream, std::uint64_t tick)
    : m_key{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
      // The second word counts the blocks drawn in its lower half and keeps the tick's high bits in
      // its upper half, so that 2^48 ticks and 65536 blocks of one tick never meet.
      m_counter{static_cast<std::uint32_t>(tick), static_cast<std::uint32_t>(tick >> 32) << 16,
                static_cast<std::uint32_t>(robot), static_cast<std::uint32_t>(stream)} {}

void CounterRandom::refill() {
  const philox4x32_ctr_t counter = {{m_counter[0], m_counter[1], m_counter[2], m_counter[3]}};
  const philox4x32_key_t key = {{m_key[0], m_key[1]}};
  const philox4x32_ctr_t block = philox4x32(counter, key);
  for (int i = 0; i < 4; ++i) m_block[i] = block.v[i];
  ++m_counter[1];
  m_used = 0;
}

std::uint64_t CounterRandom::bits() {
  if (m_used > 2) refill();
  const std::uint64_t bits = (static_cast<std::uint64_t>(m_block[m_used]) << 32) |
                             static_cast<std::uint64_t>(m_block[m_used + 1]);
  m_used += 2;
  return bits >> 11;
}

double CounterRandom::uniform() {
  return static_cast<double>(bits()) * 0x1.0p-53;
}

double CounterRandom::normal(double mean, double sigma) {
  if (sigma == 0.0) return mean;
  // In the middle of its step, so that it is neither 0 nor 1.
  return mean + sigma * quantile::normal((static_cast<double>(bits()) + 0.5) * 0x1.0p-53);
}

}  // namespace pitchboard
