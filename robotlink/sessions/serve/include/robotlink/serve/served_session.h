// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A recorded session as the source of a ServedMatch. One thread at a time.

#include <functional>
#include <vector>

#include <robotlink/serve/served_match.h>
#include <robotlink/session/recorded_frame.h>
#include <telemetry/session/session_reader.h>

namespace pitchboard::link {

class ServedSession {
 public:
  /// Offers the groups of the session, which must not be empty. Session and server must live as
  /// long.
  ServedSession(const telemetry::SessionReader& session, telemetry::FoxgloveServer& server);

  telemetry::TimeRange range() const { return m_range; }
  /// The moment shown, in s of the session; the first one before anything was shown.
  double time() const { return m_time; }
  /// Shows what holds at this moment, limited to the session.
  void show(double time);
  /// Shows everything that happened between the moment shown and this one, which is not before it;
  /// what is left is left out once `goesOn` returns false.
  void playTo(double time, const std::function<bool()>& goesOn);
  /// Returns what clients are told of the playback: it plays, is paused at the moment shown, or has
  /// ended.
  telemetry::FoxglovePlaybackState playback(bool plays, double speed) const;

 private:
  const telemetry::SessionReader& m_session;
  telemetry::TimeRange m_range;
  std::vector<telemetry::SessionEvent> m_events;
  RecordedFrames m_frames;
  std::vector<telemetry::SessionRow> m_rows;
  ServedMatch m_served;
  double m_time;
};

}  // namespace pitchboard::link
