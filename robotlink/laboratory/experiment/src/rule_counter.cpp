// SPDX-License-Identifier: GPL-3.0-or-later
#include "rule_counter.h"

#include <cmath>
#include <limits>

namespace pitchboard::link {

void RuleCounter::ticked(const SimulatedMatch& /*match*/, std::chrono::nanoseconds /*tickTime*/) {
  constexpr int ticksAtOnce = 120;
  if (++m_fresh < ticksAtOnce) return;
  m_fresh = 0;
  const telemetry::QueryRows rows(*m_rows);
  const auto range = rows.range();
  // A change by hand adds a row of the same time.
  if (range) {
    (void)m_watch.advance(rows,
                          std::nextafter(range->end, -std::numeric_limits<double>::infinity()));
  }
  count(m_watch.takeEnded());
}

std::vector<double> RuleCounter::finish() {
  const telemetry::QueryRows rows(*m_rows);
  if (const auto range = rows.range()) (void)m_watch.advance(rows, range->end);
  count(m_watch.takeEnded());
  count(m_watch.open());
  std::vector<double> out = m_counts;
  for (const telemetry::UnansweredQuestion& one : m_watch.unanswered()) {
    out[one.question] = std::numeric_limits<double>::quiet_NaN();
  }
  return out;
}

}  // namespace pitchboard::link
