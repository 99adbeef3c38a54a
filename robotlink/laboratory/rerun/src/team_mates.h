// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The messages that a robot's team process got. They are not recorded, but follow from the
// blackboards of its team-mates: the team process of each runs on what was recorded of it, and
// posts what it posted then. Private to the module; one thread.

#include <memory>
#include <vector>

#include <robotlink/cognition/team_channel.h>

#include "feed.h"
#include "recorded_robot.h"

namespace pitchboard::link {

class TeamMates {
 public:
  /// Returns whether the recording has the blackboard of a team-mate.
  static bool areRecorded(const telemetry::SessionReader& session, const RecordedRobot& recorded);

  TeamMates(const telemetry::SessionReader& session, const RecordedRobot& recorded);

  /// Returns the groups whose rows take() needs.
  const std::vector<telemetry::GroupId>& groups() const { return m_groups; }
  /// Takes a row of a team-mate, in the order of the session.
  Result<void> take(telemetry::GroupId group, const telemetry::RowView& row);
  /// Returns the channel on which the messages come.
  const std::shared_ptr<InProcessTeamChannel>& channel() const { return m_channel; }

 private:
  struct Mate {
    Feed feed;
    Blackboard board;
    RerunRobot robot;
    std::unique_ptr<RerunProgram> program;  // made at its first row
  };
  double m_tickRate;
  std::shared_ptr<InProcessTeamChannel> m_channel;
  std::vector<telemetry::GroupId> m_groups;
  std::vector<std::unique_ptr<Mate>> m_mates;  // in the same order; programs refer to boards
};

}  // namespace pitchboard::link
