// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/monitor/sequence_stats.h>

#include <algorithm>

namespace pitchboard::telemetry {
namespace {

constexpr std::uint64_t maxLate = 32, seenNumbers = 64;
// At 60 messages a second more than four hours; what is further ahead is no counter.
constexpr std::uint64_t mostAhead = std::uint64_t{1} << 20;
constexpr std::uint64_t mostAheadOfAnother = 1000;

}  // namespace

std::uint64_t SequenceStats::modulus() const {
  const int bits = m.bits > 0 ? m.bits : m.highest < (1 << 8) ? 8 : m.highest < (1 << 16) ? 16 : 32;
  return std::uint64_t{1} << bits;
}

SequenceStats::Step SequenceStats::add(std::int64_t number, bool moved) {
  // A counter that runs over in a signed type goes on at its lowest value.
  const Step step = stepTo(static_cast<std::uint64_t>(number) & 0xffff'ffffU, moved);
  if (step == Step::Duplicate) {
    ++m.duplicates;
  } else {
    ++m.received;
  }
  return step;
}

SequenceStats::Step SequenceStats::stepTo(std::uint64_t number, bool moved) {
  if (m.bits > 0) number &= modulus() - 1;
  m.highest = std::max(m.highest, number);
  if (!m.newest) {
    m.newest = number;
    m.seen = m.span = 1;
    return Step::First;
  }
  const std::uint64_t all = modulus();
  const std::uint64_t newest = *m.newest;
  const bool below = number < newest;
  const std::uint64_t ahead = (number + all - newest) % all;
  if (ahead == 0) return Step::Duplicate;
  const std::uint64_t behind = all - ahead;
  // A higher number is an old one only if the counter has gone over its end since.
  if (behind <= maxLate && (below || behind < m.span)) {
    const std::uint64_t bit = std::uint64_t{1} << behind;
    if ((m.seen & bit) != 0) return Step::Duplicate;
    m.seen |= bit;
    ++m.late;
    // It was counted as lost when the later one came, unless it is older than the first.
    if (behind < m.span && m.lost > 0) --m.lost;
    return Step::Late;
  }
  m.newest = number;
  const std::uint64_t most = below   ? std::min(mostAheadOfAnother, all / 4)
                             : moved ? mostAheadOfAnother
                                     : mostAhead;
  if (ahead > most) {
    m.seen = m.span = 1;
    ++m.restarts;
    return Step::Restart;
  }
  m.seen = ahead < seenNumbers ? m.seen << ahead | 1 : 1;
  m.span += ahead;
  m.lost += ahead - 1;
  return ahead == 1 ? Step::Next : Step::Gap;
}

double SequenceStats::loss() const {
  const std::uint64_t sent = m.lost + m.received;
  return sent == 0 ? 0.0 : static_cast<double>(m.lost) / static_cast<double>(sent);
}

}  // namespace pitchboard::telemetry
