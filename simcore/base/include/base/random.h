// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Counter-based random numbers: each is a pure function of (seed, robot, stream, tick, index). So a
// run repeats bit for bit, any moment can be restored, and adding a robot does not change the noise
// of another one. The generator is Philox4x32-10 (Salmon et al., SC 2011) of the library Random123.

#include <cstdint>

namespace pitchboard {

/// The kind of noise. It is part of the key, so streams never share numbers.
enum class NoiseStream : std::uint32_t {
  Motion = 1,
  Kick = 2,
  BallVision = 3,
  RobotVision = 4,
  Landmarks = 5,
  Imu = 6,
  Behaviour = 7,
  Coin = 8
};

/// The random numbers of one (robot, stream, tick), in order. A small value, cheap to create.
class CounterRandom {
 public:
  CounterRandom(std::uint64_t seed, int robot, NoiseStream stream, std::uint64_t tick);

  /// Returns a uniform number in [0, 1).
  double uniform();
  /// Returns a normally distributed number. Uses one random number, or none if sigma is 0.
  double normal(double mean, double sigma);

 private:
  void refill();
  /// Returns 53 random bits.
  std::uint64_t bits();

  std::uint32_t m_key[2];
  std::uint32_t m_counter[4];
  std::uint32_t m_block[4] = {};
  int m_used = 4;
};

}  // namespace pitchboard
