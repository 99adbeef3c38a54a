// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Rate and jitter of one robot's messages. Seconds; not thread-safe.

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include <telemetry/wire/datagram.h>

namespace pitchboard::telemetry {

/// Rate and jitter over the last 32 messages.
class ArrivalStats {
 public:
  void add(WallTime time);
  /// Messages per second, falling while nothing comes; 0 until there are two.
  double rate(WallTime now) const;
  /// Standard deviation of the time between messages, seconds; 0 until there are three.
  double jitter() const;
  /// Those of the last messages, oldest first: adding them to a new object makes the same one.
  std::vector<WallTime> times() const;
  /// Mean time between messages; nothing until there are two.
  std::optional<Duration> interval() const;

 private:
  static constexpr std::size_t window = 32;
  WallTime at(std::size_t index) const {
    return m_times[(m_next + window - m_count + index) % window];
  }
  std::array<WallTime, window> m_times{};
  std::size_t m_next = 0, m_count = 0;
};

}  // namespace pitchboard::telemetry
