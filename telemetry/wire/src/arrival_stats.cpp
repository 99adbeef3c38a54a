// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/wire/arrival_stats.h>

#include <algorithm>
#include <cmath>

namespace pitchboard::telemetry {
void ArrivalStats::add(WallTime time) {
  m_times[m_next] = time;
  m_next = (m_next + 1) % window;
  m_count = std::min(m_count + 1, window);
}

double ArrivalStats::rate(WallTime now) const {
  if (m_count < 2) return 0.0;
  const double span = secondsOf(at(m_count - 1) - at(0));
  const double intervals = static_cast<double>(m_count - 1);
  const double silence = secondsOf(now - at(m_count - 1));
  // While the next message is not yet due the silence says nothing; after that it counts.
  const double overdue = std::max(0.0, silence - span / intervals);
  return span + overdue > 0.0 ? intervals / (span + overdue) : 0.0;
}

double ArrivalStats::jitter() const {
  if (m_count < 3) return 0.0;
  const auto intervals = static_cast<double>(m_count - 1);
  const double mean = secondsOf(at(m_count - 1) - at(0)) / intervals;
  double sum = 0.0;
  for (std::size_t i = 1; i < m_count; ++i) {
    const double difference = secondsOf(at(i) - at(i - 1)) - mean;
    sum += difference * difference;
  }
  return std::sqrt(sum / intervals);
}

std::vector<WallTime> ArrivalStats::times() const {
  std::vector<WallTime> out;
  for (std::size_t i = 0; i < m_count; ++i) out.push_back(at(i));
  return out;
}

SequenceStats::Step SequenceStats::add(std::int64_t number) {
  constexpr std::int64_t restart = 1000;
  if (!m_last) {
    m_last = number;
    ++m_received;
    return Step::First;
  }
  const std::int64_t step = number - *m_last;
  if (step == 0) return Step::Duplicate;
  ++m_received;
  if (step > restart || step < -restart) {
    m_last = number;
    return Step::Restart;
  }
  if (step < 0) {
    // It was counted as lost when the later one came.
    if (m_lost > 0) --m_lost;
    return Step::Late;
  }
  m_last = number;
  m_lost += static_cast<std::uint64_t>(step - 1);
  return step == 1 ? Step::Next : Step::Gap;
}

double SequenceStats::loss() const {
  const std::uint64_t sent = m_lost + m_received;
  return sent == 0 ? 0.0 : static_cast<double>(m_lost) / static_cast<double>(sent);
}

}  // namespace pitchboard::telemetry
