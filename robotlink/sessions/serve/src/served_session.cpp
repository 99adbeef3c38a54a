// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/serve/served_session.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pitchboard::link {

ServedSession::ServedSession(const telemetry::SessionReader& session,
                             telemetry::FoxgloveServer& server)
    : m_session(session),
      m_range(*session.range()),
      m_events(session.events()),
      m_frames(backdropOf(session)),
      m_served(server, [&session](double seconds) { return session.logTime(seconds); }),
      m_time(m_range.begin) {
  for (const auto& group : session.groups()) m_served.addGroup(group.info);
}

void ServedSession::show(double time) {
  m_time = std::clamp(time, m_range.begin, m_range.end);
  m_session.rowsAt(m_time, m_rows);
  for (std::size_t g = 0; g < m_rows.size(); ++g) {
    if (m_rows[g].present) m_served.append(static_cast<telemetry::GroupId>(g), m_rows[g].view());
  }
  m_served.show(m_frames.frameAt(m_session, m_time));
  m_served.setTime(m_time);
}

void ServedSession::playTo(double time, const std::function<bool()>& goesOn) {
  const double begin = std::nextafter(m_time, std::numeric_limits<double>::infinity());
  m_time = std::clamp(time, m_time, m_range.end);
  m_session.walk({begin, m_time}, [&](const telemetry::SessionItem& item) {
    if (item.isRow) {
      m_served.append(item.group, item.row);
    } else if (item.stream == telemetry::SessionStream::Log) {
      if (const auto line = telemetry::sessionLogLine(item.message->data)) m_served.append(*line);
    }
    return goesOn();
  });
  for (const telemetry::SessionEvent& event : m_events) {
    if (event.time >= begin && event.time <= m_time) m_served.append(event);
  }
  m_served.show(m_frames.frameAt(m_session, m_time));
  m_served.setTime(m_time);
}

telemetry::FoxglovePlaybackState ServedSession::playback(bool plays, double speed) const {
  using Status = telemetry::FoxglovePlaybackState::Status;
  telemetry::FoxglovePlaybackState state;
  state.status = plays ? Status::Playing : m_time >= m_range.end ? Status::Ended : Status::Paused;
  state.time = m_session.logTime(m_time);
  state.speed = speed;
  return state;
}

}  // namespace pitchboard::link
