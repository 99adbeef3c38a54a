// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Many nearly normal numbers in little time, for the spread of particles, where the exact shape of
// the bell does not matter. Each is the sum of four uniform 16-bit numbers (Irwin-Hall: mean 0,
// variance 1, nothing beyond +-3.46) cut out of one 64-bit hash (the finalizer of SplitMix64). A
// pure function of (seed, robot, update, index), like CounterRandom, whose block keys it.

#include <cstdint>

#include <Eigen/Core>

#include <base/random.h>

namespace pitchboard::link {

class FastNoise {
 public:
  FastNoise(std::uint64_t seed, int robot, std::uint64_t update) {
    CounterRandom random(seed, robot, NoiseStream::Behaviour, update);
    m_state = static_cast<std::uint64_t>(random.uniform() * 0x1p53) * 0x9E3779B97F4A7C15ULL;
  }

  void fillNormal(Eigen::ArrayXf& out, int count) {
    constexpr float scale = 1.7320508F / 65536.0F;  // makes the variance 4/12 of the sum a 1
    for (int i = 0; i < count; ++i) {
      m_state += 0x9E3779B97F4A7C15ULL;
      std::uint64_t z = m_state;
      z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
      z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
      z ^= z >> 31;
      const auto sum = static_cast<std::int32_t>((z & 0xFFFF) + ((z >> 16) & 0xFFFF) +
                                                 ((z >> 32) & 0xFFFF) + (z >> 48));
      out[i] = static_cast<float>(sum - 131070) * scale;
    }
  }

 private:
  std::uint64_t m_state;
};

}  // namespace pitchboard::link
