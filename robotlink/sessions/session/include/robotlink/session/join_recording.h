// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Joins what a robot recorded itself (pitchboard-agent --record) to a live session of the same
// match. There it replaces the values of the robot's blackboard that were received, or stands
// beside its messages if none were. The robot's clock is mapped to the session's by the changes
// that both contain. Seconds. Runs on the calling thread; the new session is written on a thread of
// its own.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <base/result.h>
#include <robotlink/session/clock_comparison.h>

namespace pitchboard::link {

/// A robot of a session to which a recording can be joined.
struct JoinTarget {
  std::string robot;
  telemetry::GroupId group = 0;  ///< its rows that are compared
  bool isBoard = false;          ///< the rows are replaced; otherwise they are messages, and stay
  bool isProposed = false;       ///< it has the number of the recording
};
/// Returns the robots of the session, those that are proposed first.
std::vector<JoinTarget> joinTargets(const telemetry::SessionReader& session,
                                    const RobotRecording& recording);

/// A target, and how its clock compares with that of the recording.
struct ComparedTarget {
  JoinTarget target;
  ClockComparison comparison;
  Result<ClockFit> fit;
};
/// Compares the robot of this name; empty: the one that is proposed; if several are, because both
/// teams have that number, the one with whom more changes agree. Fails with NotFound, with the
/// names that there are, and with Conflict if `goesOn` returns false.
Result<ComparedTarget> compareTarget(const telemetry::SessionReader& session,
                                     const RobotRecording& recording, const std::string& robot,
                                     const std::function<bool()>& goesOn = {});

struct JoinOptions {
  std::string robot;                    ///< as compareTarget() takes it
  std::optional<double> offset, drift;  ///< given by hand, instead of estimated
  bool replace = false;                 ///< an existing output
};

struct JoinReport {
  std::string robot;
  RobotClock clock;
  std::optional<ClockFit> fit;  ///< empty: the clock was given
  ClockAgreement agreement;
  std::size_t files = 1;           ///< of the recording
  std::uint64_t rows = 0;          ///< of the recording
  std::uint64_t replaced = 0;      ///< rows of the session that they replace
  std::vector<std::string> notes;  ///< sentences about files that are missing
  /// Returns a line for people, with offset, drift and residual.
  std::string summary() const;
};

/// Writes the joined session. Fails as compareTarget() does; with NotFound if the clock is not
/// given and cannot be estimated, with Conflict if `progress` (0 to 1) returns false, and as
/// FileTarget does.
Result<JoinReport> joinRecording(const std::string& session, const std::string& recording,
                                 const std::string& output, const JoinOptions& options,
                                 const std::function<bool(double)>& progress = {});

}  // namespace pitchboard::link
