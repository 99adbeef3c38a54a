// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Counter-based randomness: a draw is a pure function of (seed, robot, stream, tick, index), so a
// run repeats bit for bit, any recorded moment can be re-entered, and adding a robot does not
// change another one's noise. Generator: Philox4x32-10 (Salmon et al., SC 2011), package Random123.

#include <cstdint>

namespace pitchboard {

/// Which noise a draw belongs to; part of the key, so streams never share numbers.
enum class NoiseStream : std::uint32_t {
  Motion = 1,
  Kick = 2,
  BallVision = 3,
  RobotVision = 4,
  Landmarks = 5,
  Imu = 6,
  Behaviour = 7
};

/// Draws for one (robot, stream, tick), in order. A value of a few words; make one where needed.
class CounterRandom {
 public:
  CounterRandom(std::uint64_t seed, int robot, NoiseStream stream, std::uint64_t tick);

  /// Uniform in [0, 1).
  double uniform();
  /// Normal with the given mean and standard deviation, from one draw; none when sigma is 0.
  double normal(double mean, double sigma);

 private:
  void refill();
  /// 53 random bits.
  std::uint64_t bits();

  std::uint32_t m_key[2];
  std::uint32_t m_counter[4];
  std::uint32_t m_block[4] = {};
  int m_used = 4;
};

}  // namespace pitchboard
