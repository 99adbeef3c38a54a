// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Many nearly normal numbers in little time, for the spread of particles, where the exact shape of
// the bell does not matter. A sequence that begins with (seed, robot) and belongs to one filter:
// the same inputs give the same numbers, and no robot shifts those of another.

#include <cstddef>
#include <cstdint>

#include <base/random.h>

#include "localization/particle_kernels.h"

namespace pitchboard::link {

class FastNoise {
 public:
  FastNoise(std::uint64_t seed, int robot) {
    // A tick that no update has: the filter's other draws have keys of their own.
    CounterRandom random(seed, robot, NoiseStream::Behaviour, ~std::uint64_t{0});
    // The finalizer of SplitMix64 makes the many words of the states from one draw.
    auto key = static_cast<std::uint64_t>(random.uniform() * 0x1p53) * 0x9E3779B97F4A7C15ULL;
    const auto next = [&key] {
      key += 0x9E3779B97F4A7C15ULL;
      std::uint64_t z = key;
      z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
      z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
      return z ^ (z >> 31);
    };
    for (std::size_t i = 0; i < m_lanes.x.size(); ++i) {
      const std::uint64_t first = next(), second = next();
      m_lanes.x[i] = static_cast<std::uint32_t>(first);
      m_lanes.y[i] = static_cast<std::uint32_t>(first >> 32);
      m_lanes.z[i] = static_cast<std::uint32_t>(second);
      m_lanes.w[i] = static_cast<std::uint32_t>(second >> 32) | 1U;
    }
  }

  /// `out` has particles::capacityFor(count) places.
  void fillNormal(float* out, int count) { particles::kernels().fillNormal(m_lanes, out, count); }

 private:
  particles::NoiseLanes m_lanes;
};

}  // namespace pitchboard::link
