// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What happened between two live frames, in words: game states, goals, penalties, robots that fall
// silent or come back. Private to robotlink.

#include <map>

#include <robotlink/live/live_watch.h>

namespace pitchboard::link {

struct LiveHappenings {
  std::vector<sim::Event> events;
  std::vector<LogLine> lines;
};

/// Compares with the frame given before; the first frame gives what is there to tell.
class LiveEvents {
 public:
  LiveHappenings compare(const MatchFrame& now);
  /// Ports that cannot be bound, and those that now can.
  std::vector<LogLine> comparePorts(const telemetry::ReceiverStatus& network, double time);
  void clear() { *this = {}; }

 private:
  struct Known {
    bool timedOut = false;
    bool conflict = false;
    std::optional<Penalty> penalty;
  };
  void compareReferee(const RefereeView& now, double time, LiveHappenings& out);
  void compareRobot(const RobotFrame& heard, double time, LiveHappenings& out);

  std::optional<RefereeView> m_referee;
  std::map<RobotId, Known> m_robots;
  std::map<std::uint16_t, std::string> m_ports;
};

}  // namespace pitchboard::link
