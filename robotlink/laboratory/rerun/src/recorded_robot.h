// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a recording tells of the robot that runs again: its rows, its map of variables, who it was,
// and what ran on it. Private to the module; a value, any thread. Seconds of the session.

#include <optional>
#include <string>
#include <vector>

#include <robotlink/blackboard/variable_catalog.h>
#include <robotlink/processes/runtime_profile.h>
#include <robotlink/rerun/rerun.h>
#include <robotlink/scenario/scenario.h>

#include "rerun_program.h"

namespace pitchboard::link {

constexpr double rowTolerance = 1e-6;  // s; files keep whole nanoseconds

struct RecordedRobot {
  telemetry::GroupId group = 0;
  std::string name;  ///< "B1"
  VariableCatalog catalog = VariableCatalog::extended();
  std::optional<Scenario> scenario;  ///< of a simulated match
  RerunRobot robot;
  RuntimeChoice runtime;                 ///< programs that it had; not chosen: ours
  std::vector<BlackboardWrite> planned;  ///< by the scenario
  bool hasWorld = false;                 ///< what it sensed can be played again
  double tickRate = 100.0, rowInterval = 0.0;
  double begin = 0.0;  ///< of its first row

  std::uint64_t tickOf(double time) const;
  /// Returns what ran as this process, as RerunProcess::program; empty if it is not known.
  /// `session` is the recording's file.
  std::string programOf(const std::string& process, const std::string& session) const;
};

/// Returns whether these are rows of a robot.
bool isRobotGroup(const telemetry::SessionGroup& group);

/// Finds the robot of RerunOptions::robot. Fails with NotFound.
Result<RecordedRobot> recordedRobot(const telemetry::SessionReader& session,
                                    const RerunOptions& options);

}  // namespace pitchboard::link
