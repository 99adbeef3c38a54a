// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Counts lost, duplicate and late messages by the sequence numbers of a robot. Counters of 8, 16
// and 32 bits may wrap, and a robot that restarts begins again. Plain values; not thread-safe.

#include <cstdint>
#include <optional>

namespace pitchboard::telemetry {

class SequenceStats {
 public:
  enum class Step { First, Next, Gap, Late, Duplicate, Restart };

  /// The complete state; an object made of it continues in the same way.
  struct Counts {
    int bits = 0;
    std::optional<std::uint64_t> newest;
    std::uint64_t highest = 0;
    std::uint64_t seen = 0;  ///< bit n: the number n before the newest was received
    std::uint64_t span = 0;  ///< numbers from the first one since the start to the newest
    std::uint64_t received = 0, lost = 0, duplicates = 0, late = 0, restarts = 0;
  };

  /// `bits` is the size of the counter: 8, 16 or 32. 0 means unknown; then it is the smallest of
  /// these that holds the highest number so far.
  SequenceStats() = default;
  explicit SequenceStats(int bits) { m.bits = bits; }
  explicit SequenceStats(const Counts& counts) : m(counts) {}
  const Counts& counts() const { return m; }

  /// Takes the number of the next message. It is Late if it is older than an earlier one by at most
  /// 32. A gap of up to 2^20 counts as loss; only up to 1000 (and a quarter of the counter's range)
  /// if the sender's address changed or the counter wrapped, because a restarted program looks the
  /// same. Everything else is a Restart.
  Step add(std::int64_t number, bool moved = false);

  std::uint64_t received() const { return m.received; }  ///< without duplicates
  std::uint64_t lost() const { return m.lost; }
  std::uint64_t duplicates() const { return m.duplicates; }
  std::uint64_t late() const { return m.late; }
  std::uint64_t restarts() const { return m.restarts; }
  /// Returns the share of messages that did not arrive, 0 to 1.
  double loss() const;

 private:
  std::uint64_t modulus() const;
  Step stepTo(std::uint64_t number, bool moved);

  Counts m;
};

}  // namespace pitchboard::telemetry
