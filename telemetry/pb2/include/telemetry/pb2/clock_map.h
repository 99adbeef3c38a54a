// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Maps the clock of a sender to ours by the minimum-delay filter: of the datagrams of the last
// minute the one that took the shortest time shows how far the clocks are apart. What is left is
// that shortest delay, some milliseconds at most on a local network. Not thread-safe.

#include <array>
#include <cstdint>
#include <optional>

namespace pitchboard::telemetry {

class ClockMap {
 public:
  /// Our time (s) at which a datagram was sent that carries the sender's `sent` (ms) and came at
  /// `arrival` (s). Never less than what was returned before, and never later than `arrival` or
  /// that: times of rows stay in order. The datagrams must come in the order in which they were
  /// sent: late ones are left out.
  double map(std::uint64_t sent, double arrival);

  /// Our clock minus the sender's, s, with the least delay in it. 0 before the first datagram.
  double offset() const;
  /// How unevenly datagrams arrive, s: the mean change of the delay from one to the next, as RTP
  /// measures it (RFC 3550).
  double jitter() const { return m_jitter; }
  /// How often the sender's clock was found to have begun anew: after a reboot or a sleep.
  std::uint64_t restarts() const { return m_restarts; }

 private:
  static constexpr double bucketSeconds = 10.0;
  static constexpr std::size_t bucketCount = 6;
  struct Bucket {
    double begin = 0.0, least = 0.0;
  };
  double least() const;
  void begin(std::uint64_t sent);

  std::optional<std::uint64_t> m_first;  // ms; offsets count from here, so that doubles are exact
  std::uint64_t m_newest = 0;            // ms
  std::array<Bucket, bucketCount> m_buckets{};
  std::size_t m_used = 0, m_now = 0;  // buckets in use, and the one that is being filled
  double m_returned = 0.0, m_delay = 0.0, m_jitter = 0.0;
  int m_far = 0;  // datagrams in a row that came much later than the least delay
  std::uint64_t m_restarts = 0;
};

}  // namespace pitchboard::telemetry
