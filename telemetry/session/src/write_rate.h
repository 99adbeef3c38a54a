// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How fast a file has been growing lately, for saying when the disk will be full. One thread.

#include <cstdint>
#include <deque>

namespace pitchboard::telemetry {

class WriteRate {
 public:
  /// The size at this moment (s of any clock that does not go back).
  void note(double seconds, std::uint64_t bytes);
  /// Over the last minute; 0 until there are some seconds to judge by.
  double bytesPerSecond() const;

 private:
  struct Sample {
    double seconds;
    std::uint64_t bytes;
  };
  std::deque<Sample> m_samples;
};

}  // namespace pitchboard::telemetry
