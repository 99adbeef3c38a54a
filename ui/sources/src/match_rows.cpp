// SPDX-License-Identifier: GPL-3.0-or-later
#include "match_rows.h"

#include <algorithm>

namespace pitchboard::ui {

telemetry::GroupId MatchRows::addGroup(const telemetry::GroupInfo& info) {
  return m_store.addGroup(info);
}

void MatchRows::append(telemetry::GroupId group, const telemetry::RowView& row) {
  // Only this thread changes the time: it may look without the lock.
  if (row.time != m_time || !m_matchBegan) {
    const std::lock_guard lock(m_mutex);
    m_step = m_matchBegan ? std::max(0.0, row.time - m_time) : 0.0;
    m_time = row.time;
    m_arrived = Clock::now();
    m_matchBegan = true;
  }
  m_store.append(group, row);
}

void MatchRows::rewind(double time) {
  {
    const std::lock_guard lock(m_mutex);
    m_step = 0.0;
    m_time = time;
  }
  m_store.rewind(time);
}

// Between two ticks time goes on as it does on the wall, but never past the next tick.
double MatchRows::timeBeside() {
  const std::lock_guard lock(m_mutex);
  const double since = std::chrono::duration<double>(Clock::now() - m_arrived).count();
  return m_matchBegan ? m_time + std::min(since, m_step) : 0.0;
}

}  // namespace pitchboard::ui
