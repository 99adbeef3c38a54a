// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/pb2/clock_map.h>

#include <algorithm>
#include <cmath>

namespace pitchboard::telemetry {
namespace {

constexpr double milliseconds = 0.001;
constexpr double mostBack = 1.0;  // s; a clock that goes back by more has begun again
constexpr double farDelay = 2.0;  // s above the least one
constexpr int mostFar = 10;       // in a row: no network, the sender's clock stood still
constexpr double jitterShare = 1.0 / 16.0;

/// The later minus the earlier one, s, also where the counter goes round.
double secondsBetween(std::uint64_t earlier, std::uint64_t later) {
  return static_cast<double>(static_cast<std::int64_t>(later - earlier)) * milliseconds;
}

}  // namespace

void ClockMap::begin(std::uint64_t sent) {
  m_first = m_newest = sent;
  m_used = m_now = 0;
  m_far = 0;
}

double ClockMap::least() const {
  double least = m_buckets[0].least;
  for (std::size_t i = 1; i < m_used; ++i) least = std::min(least, m_buckets[i].least);
  return least;
}

double ClockMap::offset() const {
  return m_used == 0 ? 0.0 : least() - static_cast<double>(*m_first) * milliseconds;
}

double ClockMap::map(std::uint64_t sent, double arrival) {
  const bool wentBack = m_first && secondsBetween(m_newest, sent) < -mostBack;
  if (wentBack) ++m_restarts;
  if (!m_first || wentBack) begin(sent);
  double apart = arrival - secondsBetween(*m_first, sent);
  if (m_used > 0) {
    m_far = apart - least() > farDelay ? m_far + 1 : 0;
    if (m_far == mostFar) {
      ++m_restarts;
      begin(sent);
      apart = arrival;
    }
  }
  const double elapsed = secondsBetween(m_newest, sent);
  m_newest = sent;
  const bool isFirst = m_used == 0;
  if (isFirst || arrival >= m_buckets[m_now].begin + bucketSeconds) {
    m_now = isFirst ? 0 : (m_now + 1) % bucketCount;
    m_used = std::min(m_used + 1, bucketCount);
    m_buckets[m_now] = {arrival, apart};
  }
  m_buckets[m_now].least = std::min(m_buckets[m_now].least, apart);
  const double delay = apart - least();
  if (!isFirst) m_jitter += (std::abs(delay - m_delay) - m_jitter) * jitterShare;
  m_delay = delay;
  // After a shorter delay was found, times would be those of before for a while. They go on more
  // slowly instead: what was sent at two times stays two samples.
  const double behind = arrival - m_returned;
  if (elapsed > 0.0 && behind > 0.0) m_returned += std::min(elapsed, behind) / 2;
  m_returned = std::max(m_returned, secondsBetween(*m_first, sent) + least());
  return m_returned;
}

}  // namespace pitchboard::telemetry
