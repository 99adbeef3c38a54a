// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Selects robots of a session by the names that people type: which rows, datagrams, events,
// drawings, saved states and frames belong to them. One thread at a time.

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <robotlink/frame/match_frame.h>
#include <telemetry/session/session_export.h>

namespace pitchboard::link {

/// Returns which robot a group of a session is about; none for the group "match". Before 0.22,
/// sessions do not say it, and a group of a live robot counts as a robot of its own.
RobotUid uidOf(const telemetry::GroupInfo& group, telemetry::GroupId index);
/// Returns the robot that a name in the session means, as SessionReader::groupsNamed() says; none
/// if that is unclear.
RobotUid robotNamed(const telemetry::SessionReader& session, std::string_view name);

/// Some robots of a session, or all.
class RobotChoice {
 public:
  RobotChoice() = default;  ///< all
  /// Chooses robots by name; all if there are no names. Fails as SessionReader::groupsNamed().
  static Result<RobotChoice> of(const telemetry::SessionReader& session,
                                std::span<const std::string> names);
  bool isAll() const { return m_isAll; }
  /// The name counts only in sessions before 0.22.
  bool has(RobotUid robot, const std::string& name) const;

 private:
  bool m_isAll = true;
  std::set<RobotUid> m_robots;
  std::set<std::string> m_names;  // of robots without an uid
};

/// Removes the other robots and their drawings from a frame.
void keepRobots(MatchFrame& frame, const RobotChoice& robots);

/// Makes an export leave out everything of robots that are not in selection.robots. The referee's
/// packets stay, because of the score; checkpoints, which contain all robots, are left out. Use the
/// selection for one export only, and while the session exists. Fails as RobotChoice::of().
Result<void> chooseRobots(const telemetry::SessionReader& session, telemetry::ExportFormat format,
                          telemetry::ExportSelection& selection);

}  // namespace pitchboard::link
