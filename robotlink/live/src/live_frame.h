// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes frames of what was heard. A pure function of its arguments but for the identities, which
// stay with a robot as long as it is remembered. Private to robotlink.

#include <map>

#include <robotlink/live/live_watch.h>

namespace pitchboard::link {

/// Who has which id (see <robotlink/frame/second_sender.h>).
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
