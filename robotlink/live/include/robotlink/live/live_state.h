// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// All that frames of a live match are made of: what is known of robots and referee, as the
// datagrams so far say it. The watch keeps such books; written into a session from time to time
// they let a recording show every moment as it was seen, because the same datagrams then make the
// same frames. Not thread-safe; a plain value for its owner.

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <robotlink/frame/match_frame.h>
#include <robotlink/live/live_watch.h>

namespace pitchboard::link {

struct LiveState {
  explicit LiveState(const LiveOptions& options);

  telemetry::TeamMonitor monitor;
  telemetry::RefereeTracker referee;
  telemetry::DrawingStore drawings;
  /// Who drew the datagram that was taken last; empty: nobody that can be shown.
  std::optional<RobotKey> lastDrawer;

  /// As MonitorOptions, and what is drawn goes on with its robot: monitor.renamings().
  void setTeams(const telemetry::MonitorOptions& options);
  /// A datagram of a robot's port, that came so many seconds after the watch began: its drawing and
  /// its message. Nothing: it had no message.
  std::optional<telemetry::TeamMonitor::Verdict> takeRobot(const telemetry::DatagramView& datagram,
                                                           double time);
  static telemetry::RefereeTracker::Options refereeOptions(const LiveOptions& options);
  /// A datagram of the referee's port that decoded to this.
  void takeReferee(const telemetry::RefereePacket& packet, const telemetry::DatagramView& datagram);
  /// The frame of this moment, all but its serial; `time`: seconds since the watch began.
  MatchFrame frame(const LiveOptions& options, const telemetry::TeamStatus& team,
                   double time) const;
  /// As they are known by now.
  Teams teams(const LiveOptions& options) const;
  /// Forgets robots, referee and counters.
  void clear(const LiveOptions& options);

  /// As a JSON object with "time", the books and those options that frames depend on.
  std::string text(const LiveOptions& options, double time, telemetry::WallTime zero) const;
  /// Books and options of a text; `zero` may be another one than when it was written, if the times
  /// that follow count from it as well. Error ParseError.
  struct Read;
  static Result<Read> read(std::string_view json, telemetry::WallTime zero);

 private:
  /// Datagrams after which the tracker is as it is now.
  struct Kept {
    telemetry::WallTime time;
    telemetry::Sender sender;
    std::uint16_t localPort = 0;
    std::string payload;
  };
  std::optional<Kept> m_shown, m_other, m_trueData;
  std::map<std::pair<int, int>, Kept> m_replies;  // by team and player
};

struct LiveState::Read {
  LiveOptions options;
  LiveState state;
};

}  // namespace pitchboard::link
