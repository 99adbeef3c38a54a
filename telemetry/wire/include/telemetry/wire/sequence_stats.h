// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the numbers say that a robot counts its messages with: what was lost, came twice, or came
// late. Counters of 8, 16 and 32 bits wrap; a robot that starts again begins anew. Plain values;
// not thread-safe.

#include <cstdint>
#include <optional>

namespace pitchboard::telemetry {

class SequenceStats {
 public:
  enum class Step { First, Next, Gap, Late, Duplicate, Restart };

  /// All that it knows: another one made of it goes on in the same way.
  struct Counts {
    int bits = 0;
    std::optional<std::uint64_t> newest;
    std::uint64_t highest = 0;
    std::uint64_t seen = 0;  ///< bit n: the number n before the newest was received
    std::uint64_t span = 0;  ///< numbers from the first one since the start to the newest
    std::uint64_t received = 0, lost = 0, duplicates = 0, late = 0, restarts = 0;
  };

  /// `bits` of the counter: 8, 16 or 32. 0 is not known: then it has the fewest of these that hold
  /// the highest number seen.
  SequenceStats() = default;
  explicit SequenceStats(int bits) { m.bits = bits; }
  explicit SequenceStats(const Counts& counts) : m(counts) {}
  const Counts& counts() const { return m; }

  /// The number of the next message. Late: older than one that came before it, by at most 32. A
  /// gap is a loss, however long, up to 2^20 messages; from a sender that moved (another address or
  /// port), and over the end of the counter, where a program that starts again looks the same, up
  /// to 1000 (and a quarter of the counter's numbers). Everything else is a Restart.
  Step add(std::int64_t number, bool moved = false);

  std::uint64_t received() const { return m.received; }  ///< without duplicates
  std::uint64_t lost() const { return m.lost; }
  std::uint64_t duplicates() const { return m.duplicates; }
  std::uint64_t late() const { return m.late; }
  std::uint64_t restarts() const { return m.restarts; }
  /// Part of the messages that did not arrive, 0 to 1.
  double loss() const;

 private:
  std::uint64_t modulus() const;
  Step stepTo(std::uint64_t number, bool moved);

  Counts m;
};

}  // namespace pitchboard::telemetry
