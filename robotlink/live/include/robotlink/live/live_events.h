// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes the events of a live match by comparing each frame with the one before: game states, goals,
// penalties, robots that go offline or come back, ports. Part of a LivePipeline, used on its
// thread. Times are those of the frames, in seconds.

#include <map>
#include <string>
#include <vector>

#include <robotlink/frame/ball_sight.h>
#include <robotlink/frame/match_event.h>
#include <robotlink/frame/match_frame.h>
#include <telemetry/sockets/udp_receiver.h>

namespace pitchboard::link {

class LiveEvents {
 public:
  /// Returns what has happened since the last call. The first call returns events for everything
  /// that its frame contains.
  std::vector<MatchEvent> compare(const MatchFrame& now);
  /// Returns events for ports that can no longer be bound, or can be bound again, or that other
  /// programs receive, too: `shared` says which, see telemetry::sharedPortsText().
  std::vector<MatchEvent> comparePorts(const telemetry::ReceiverStatus& network,
                                       const std::string& shared, double time);
  /// `setBy` is by how much the computer's clock has been changed since the beginning. A change of
  /// a second or more becomes an event.
  std::vector<MatchEvent> compareClock(telemetry::Duration setBy, double time);

 private:
  struct Known {
    telemetry::Address address;
    bool timedOut = false;
    double lastMessage = 0.0;  // s
    bool conflict = false;
    std::optional<Penalty> penalty;
    bool batteryLow = false;
    double lowFraction = 0.0;  // when it became low
    BallSight ball;
  };
  void compareReferee(const MatchFrame& now, std::vector<MatchEvent>& out);
  void compareRobot(const RobotFrame& received, double time, std::vector<MatchEvent>& out);

  std::optional<Game> m_game;
  RefereeReception m_reception;
  std::map<RobotUid, Known> m_robots;
  std::map<std::uint16_t, std::string> m_ports;  // what was wrong with each
  std::string m_shared;
  telemetry::Duration m_setBy{};
};

}  // namespace pitchboard::link
