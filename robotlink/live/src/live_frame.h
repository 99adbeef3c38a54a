// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes frames of what was heard. A pure function of its arguments but for the identities, which
// stay with a robot as long as it is remembered. Private to robotlink.

#include <map>

#include <robotlink/live/live_watch.h>

namespace pitchboard::link {

/// Robot n is RobotId n; a second sender of the same number gets n + 65536, the third n + 131072.
class LiveIdentities {
 public:
  RobotId idOf(int number, std::uint64_t serial);
  void keepOnly(const telemetry::TeamStatus& team);
  void clear() { m_ids.clear(); }

 private:
  std::map<std::pair<int, std::uint64_t>, RobotId> m_ids;
};

/// Everything but the serial. `time`: seconds since the watch began.
MatchFrame liveFrame(const LiveOptions& options, const telemetry::TeamStatus& team,
                     const telemetry::RefereeTracker& referee, LiveIdentities& identities,
                     double time);

/// "blue" to Blue; nothing for colours that robots cannot be drawn in.
std::optional<TeamColor> teamColour(std::string_view words);

}  // namespace pitchboard::link
