// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The complete state from which frames of a live match are made: what is known of robots and
// referee after the datagrams so far. Sessions store it from time to time, so that a recording
// shows every moment as it was, because the same datagrams then make the same frames. A plain
// value, not thread-safe.

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <robotlink/frame/match_frame.h>
#include <robotlink/live/live_options.h>
#include <robotlink/live/robot_uids.h>
#include <telemetry/referee/gamecontroller.h>
#include <telemetry/referee/referee_tracker.h>

namespace pitchboard::link {

struct LiveState {
  explicit LiveState(const LiveOptions& options);

  telemetry::TeamMonitor monitor;
  telemetry::RefereeTracker referee;
  telemetry::DrawingStore drawings;
  /// Who sends under which key. Shared with those that make rows of the same robots. Null: this
  /// state comes from a session before 0.23, where a robot is identified by its key (uidOf()).
  std::shared_ptr<RobotUids> uids = std::make_shared<RobotUids>();
  /// Returns the robot whose drawing was taken last; empty if it cannot be shown.
  std::optional<RobotKey> lastDrawer;

  /// Changes the monitor's options; uids and drawings follow their robots.
  void setTeams(const telemetry::MonitorOptions& options);
  /// Takes a datagram of a robot's port that arrived at this time (s since the watch began), with
  /// its drawing and message. Returns nothing if it had no message.
  std::optional<telemetry::TeamMonitor::Verdict> takeRobot(const telemetry::DatagramView& datagram,
                                                           double time);
  static telemetry::RefereeTracker::Options refereeOptions(const LiveOptions& options);
  /// Takes a decoded datagram of the referee's port.
  void takeReferee(const telemetry::RefereePacket& packet, const telemetry::DatagramView& datagram);
  /// Returns the frame at `time` (s since the watch began), without serial.
  MatchFrame frame(const LiveOptions& options, const telemetry::TeamStatus& team,
                   double time) const;
  /// Returns the teams as they are known now.
  Teams teams(const LiveOptions& options) const;
  /// Forgets a robot; another program that uses its number takes its place.
  void forget(const RobotKey& robot);
  /// Forgets simulated robots and a simulated referee.
  void forgetSimulated(const LiveOptions& options);
  /// Forgets robots, referee and counters.
  void clear(const LiveOptions& options);

  /// Returns a JSON object with "time", the state, and the options on which frames depend.
  std::string text(const LiveOptions& options, double time, telemetry::WallTime zero) const;
  /// Restores state and options from a text. `zero` may differ from that of the text, if all later
  /// times count from it. Fails with ParseError.
  struct Read;
  static Result<Read> read(std::string_view json, telemetry::WallTime zero);

 private:
  void forgetReferee(const LiveOptions& options);
  void followKeys();

  /// Datagrams that bring the tracker into its present state.
  struct Kept {
    telemetry::WallTime time;
    telemetry::Sender sender;
    std::uint16_t localPort = 0;
    std::string payload;
  };
  std::optional<Kept> m_former, m_shown, m_late, m_other, m_trueData;
  std::map<std::pair<int, int>, Kept> m_replies;  // by team and player
};

struct LiveState::Read {
  LiveOptions options;
  LiveState state;
};

}  // namespace pitchboard::link
