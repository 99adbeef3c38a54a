// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The random numbers of one stream for all robots in a tick, or in ticks of several worlds,
// computed together: exactly the numbers that CounterRandom gives for each robot, in a fraction of
// the time. It is refilled for every stream, and allocates only if there are more numbers than
// before. A value for one thread at a time.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <base/random.h>

namespace pitchboard {

class RandomBatch {
 public:
  /// The numbers of one robot, in order; at most as many as were made.
  class Sequence {
   public:
    /// Returns a uniform number in [0, 1).
    double uniform();
    /// Returns a normally distributed number. Uses one random number, or none if sigma is 0.
    double normal(double mean, double sigma);

   private:
    friend class RandomBatch;
    Sequence(const double* wholes, const double* normals) : m_wholes(wholes), m_normals(normals) {}
    const double* m_wholes;
    const double* m_normals;
  };

  /// A tick of the world with this seed.
  struct Tick {
    std::uint64_t seed = 0, tick = 0;
    bool operator==(const Tick&) const = default;
  };
  /// Computes `count` numbers for each robot in each tick.
  void make(std::span<const Tick> ticks, NoiseStream stream, std::span<const int> robots,
            int count);
  void make(std::uint64_t seed, NoiseStream stream, std::uint64_t tick, std::span<const int> robots,
            int count) {
    const Tick one{seed, tick};
    make({&one, 1}, stream, robots, count);
  }
  /// Returns the numbers of the robot with this index in `robots`; of later ticks, the robots
  /// follow those of the first.
  Sequence of(std::size_t robot) const {
    return {m_wholes.data() + robot * m_stride, m_normals.data() + robot * m_stride};
  }

 private:
  // Of each block: the words of its key and its counter.
  std::vector<std::uint32_t> m_seedLow, m_seedHigh, m_tickLow, m_high, m_robot;
  std::vector<double> m_wholes;   // 53 random bits each, as a whole number
  std::vector<double> m_normals;  // normal quantiles; only the middle part is exact
  std::size_t m_stride = 0;       // random numbers of a robot
};

}  // namespace pitchboard
