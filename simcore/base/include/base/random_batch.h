// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The draws of one stream of all robots in a tick, made side by side: the very numbers that a
// CounterRandom makes for each robot one by one, in a fraction of the time. Scratch memory that is
// filled anew for every stream and tick; it allocates when there are more robots than ever before.
// One thread.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <base/random.h>

namespace pitchboard {

class RandomBatch {
 public:
  /// Draws of one robot, taken in order, as from a CounterRandom; at most as many as were made.
  class Draws {
   public:
    /// Uniform in [0, 1).
    double uniform();
    /// Normal with the given mean and standard deviation, from one draw; none when sigma is 0.
    double normal(double mean, double sigma);

   private:
    friend class RandomBatch;
    Draws(const double* wholes, const double* normals) : m_wholes(wholes), m_normals(normals) {}
    const double* m_wholes;
    const double* m_normals;
  };

  /// Makes `count` numbers for each robot.
  void make(std::uint64_t seed, NoiseStream stream, std::uint64_t tick, std::span<const int> robots,
            int count);
  /// Of the robot at this place in `robots`.
  Draws of(std::size_t robot) const {
    return {m_wholes.data() + robot * m_stride, m_normals.data() + robot * m_stride};
  }

 private:
  std::vector<std::uint32_t> m_high, m_robot;  // of each block: what differs in its counter
  std::vector<double> m_wholes;                // 53 random bits each, as a whole number
  std::vector<double> m_normals;               // their quantiles, right in the middle only
  std::size_t m_stride = 0;                    // draws of a robot
};

}  // namespace pitchboard
