// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Messages of robots as the monitor of a team takes them.

#include <telemetry/monitor/team_monitor.h>

namespace monitor_rig {

using namespace pitchboard::telemetry;
using namespace std::chrono_literals;
using Verdict = TeamMonitor::Verdict;

inline const WallTime start{1'700'000'000s};

inline Sender from(unsigned host, int port = 5000) {
  return {{0x0a000000U + host}, static_cast<std::uint16_t>(port)};
}

inline std::string text(int robot, int flags = 1, int voltage = 124,
                        const std::string& extra = "") {
  const std::string f = " " + std::to_string(flags);
  return std::to_string(robot) + " 450 300 90 9.5 80 10" + f + f + f + f + f + " 8 0.5 " +
         std::to_string(voltage) + extra + " OUT";
}

inline Verdict give(TeamMonitor& monitor, const std::string& payload, WallTime time,
                    Sender sender = from(1)) {
  return monitor.take({time, sender, 1241, false, payload});
}

}  // namespace monitor_rig
