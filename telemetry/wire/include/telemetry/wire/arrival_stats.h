// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Rate, jitter and loss of one robot's messages.

#include <array>
#include <cstddef>
#include <cstdint>
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

 private:
  static constexpr std::size_t window = 32;
  WallTime at(std::size_t index) const {
    return m_times[(m_next + window - m_count + index) % window];
  }
  std::array<WallTime, window> m_times{};
  std::size_t m_next = 0, m_count = 0;
};

/// What the sequence numbers of a robot say.
class SequenceStats {
 public:
  enum class Step { First, Next, Gap, Late, Duplicate, Restart };
  /// All that it knows.
  struct Counts {
    std::optional<std::int64_t> last;
    std::uint64_t lost = 0, received = 0;
  };
  SequenceStats() = default;
  explicit SequenceStats(const Counts& counts)
      : m_last(counts.last), m_lost(counts.lost), m_received(counts.received) {}
  Counts counts() const { return {m_last, m_lost, m_received}; }

  /// A number more than 1000 ahead or behind is a robot that has started again.
  Step add(std::int64_t number);
  std::uint64_t lost() const { return m_lost; }
  std::uint64_t received() const { return m_received; }
  /// Part of the messages that did not arrive, 0 to 1.
  double loss() const;

 private:
  std::optional<std::int64_t> m_last;
  std::uint64_t m_lost = 0, m_received = 0;
};

}  // namespace pitchboard::telemetry
