// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The options of Live: where to receive, whom to accept, and how messages and teams are read. A
// plain value, any thread.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <base/options.h>
#include <robotlink/live/attached_robots.h>
#include <robotlink/live/foxglove_source.h>
#include <simcore/world/field.h>
#include <telemetry/monitor/monitor_request.h>
#include <telemetry/monitor/team_monitor.h>
#include <telemetry/pb2/pb2.h>

namespace pitchboard::link {

struct LiveOptions {
  LiveOptions() { team.battery = telemetry::defaultBattery; }
  telemetry::Address bind{};  ///< 0.0.0.0: all interfaces, unicast and broadcast
  int portBase = 1240;        ///< robot n sends to portBase + n
  int robots = 16;            ///< number of robots' ports
  int refereePort = 3838;
  /// Robot n sends its variables to this port + n (docs/agent.md); 0: do not receive variables.
  int variablesPortBase = telemetry::pb2PortBase;
  int refereeVersion = 0;                    ///< packet version to show; 0: the highest received
  telemetry::SenderFilter refereeSenders{};  ///< for robots, see `team`
  /// Also receive the robots and the referee of simulated matches on this computer. The robots are
  /// called "Simulated 1", and the referee is shown only while there is no real one.
  bool simulated = false;
  telemetry::Profile profile = telemetry::publishedProfile();
  std::string
      profileFile{};  ///< or name of the profile; empty: the published one, or one of a team
  telemetry::MonitorOptions team;
  int ourTeam = 0;                       ///< our team's number at the referee; 0: not chosen
  std::optional<TeamColor> ourColour{};  ///< set if our team was chosen by its colour
  bool colourByNumber = false;           ///< the colour follows from the robot's number (published)
  sim::FieldSpec field;
  std::vector<AttachedBoard> boards;          ///< blackboards on this computer
  std::vector<FoxgloveSource> foxglove;       ///< programs whose topics are shown
  std::vector<std::string> catalogs;          ///< files that list the variables robots send
  std::optional<telemetry::Address> monitor;  ///< referee to ask for monitor mode; empty: off
  std::uint16_t monitorPort = telemetry::monitorRequestPort;
};

/// Returns the table of the options, in the order of dialogs. Setting one may read a file. The
/// options that recordings keep besides are in LiveState::text().
std::span<const Option<LiveOptions>> liveOptionTable();
/// Returns the row with this key, which must be one of the table.
const Option<LiveOptions>& liveOption(std::string_view key);

/// Returns whether empty is less than low, and low less than full.
bool isPossible(const telemetry::BatteryLimits& battery);

/// Returns all ports to receive on. Error InvalidArgument if a port is out of range or used twice.
Result<std::vector<std::uint16_t>> portsOf(const LiveOptions& options);
/// Fails as portsOf() does, for an impossible battery, and if a file cannot be read.
Result<void> validate(const LiveOptions& options);

}  // namespace pitchboard::link
