// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/monitor/arrival_stats.h>

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
  const double gap = secondsOf(now - at(m_count - 1));
  // While the next message is not yet due the silence says nothing; after that it counts.
  const double overdue = std::max(0.0, gap - span / intervals);
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

std::optional<Duration> ArrivalStats::interval() const {
  if (m_count < 2) return std::nullopt;
  return (at(m_count - 1) - at(0)) / static_cast<Duration::rep>(m_count - 1);
}

}  // namespace pitchboard::telemetry
