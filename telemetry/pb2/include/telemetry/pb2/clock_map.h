// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Maps a sender's clock to ours with a minimum-delay filter: of the datagrams of the last minute,
// the one with the shortest delay shows how far the clocks are apart. The remaining error is that
// shortest delay, at most some milliseconds on a local network. Plain value; not thread-safe.

#include <array>
#include <cstdint>
#include <optional>

namespace pitchboard::telemetry {

class ClockMap {
 public:
  /// Returns when a datagram was sent, in our time (s). `sent` is the sender's time in the datagram
  /// (ms), `arrival` our time when it arrived (s). The result is never later than `arrival`. It
  /// never decreases, and it increases whenever `sent` does and `arrival` is later than the last
  /// result, so that rows stay in order and none replaces another. Call it for datagrams in the
  /// order in which they were sent, and leave out late ones.
  double map(std::uint64_t sent, double arrival);

  /// Returns our clock minus the sender's in s, including the shortest delay; 0 before the first
  /// datagram.
  double offset() const;
  /// Returns the mean change of the delay between datagrams in s, as RTP defines it (RFC 3550).
  double jitter() const { return m_jitter; }
  /// Counts how often the sender's clock has restarted, because it rebooted or slept.
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
  int m_far = 0;  // datagrams in a row that arrived much later than the shortest delay
  std::uint64_t m_restarts = 0;
};

}  // namespace pitchboard::telemetry
