// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Rate and jitter of one robot's messages, in seconds. Plain value; not thread-safe.

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include <telemetry/sockets/datagram.h>

namespace pitchboard::telemetry {

/// Rate and jitter over the last 32 messages.
class ArrivalStats {
 public:
  void add(WallTime time);
  /// Returns messages per second. It falls while nothing arrives, and is 0 before the second one.
  double rate(WallTime now) const;
  /// Returns the standard deviation of the time between messages, in s; 0 before the third one.
  double jitter() const;
  /// Returns the times of the last messages, oldest first. Adding them to a new object restores
  /// this.
  std::vector<WallTime> times() const;
  /// Returns the mean time between messages; nothing before the second one.
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
