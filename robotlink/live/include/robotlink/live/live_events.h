// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes the events of a live match by comparing each frame with the one before: game states, goals,
// penalties, robots that fall silent or come back, ports. Part of a LivePipeline. Times are those
// of the frames, s.

#include <map>
#include <string>
#include <vector>

#include <robotlink/frame/ball_sight.h>
#include <robotlink/live/live_watch.h>

namespace pitchboard::link {

class LiveEvents {
 public:
  /// What has happened since the frame given before; the first frame gives what is there to tell.
  std::vector<MatchEvent> compare(const MatchFrame& now);
  /// Ports that cannot be bound, and those that now can.
  std::vector<MatchEvent> comparePorts(const telemetry::ReceiverStatus& network, double time);
  /// The computer's clock is off by this much since the beginning; a second or more is told.
  std::vector<MatchEvent> compareClock(telemetry::Duration setBy, double time);
  void rename(const std::vector<Renaming>& renamings) { pitchboard::rename(m_robots, renamings); }

 private:
  struct Known {
    telemetry::Address address;
    bool timedOut = false;
    bool conflict = false;
    std::optional<Penalty> penalty;
    bool batteryLow = false;
    double lowFraction = 0.0;  // when it became low
    BallSight ball;
  };
  void compareReferee(const RefereeView& now, double time, std::vector<MatchEvent>& out);
  void compareRobot(const RobotFrame& received, double time, std::vector<MatchEvent>& out);

  std::optional<RefereeView> m_referee;
  std::map<RobotKey, Known> m_robots;
  std::map<std::uint16_t, std::string> m_ports;  // what was wrong with each
  telemetry::Duration m_setBy{};
};

}  // namespace pitchboard::link
