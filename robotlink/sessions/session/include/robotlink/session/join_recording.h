// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Joins what a robot recorded itself (pitchboard-agent --record) to a live session of the same
// match, where it replaces the values that were received from that robot. The robot's clock is
// mapped to the session's by the changes that both contain. Seconds. Runs on the calling thread;
// the new session is written on a thread of its own.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <base/result.h>
#include <telemetry/session/session_reader.h>

namespace pitchboard::link {

/// Time of the session = time of the recording × (1 + drift) + offset.
struct ClockFit {
  double offset = 0.0;      ///< s
  double drift = 0.0;       ///< 1e-6 are a microsecond per second
  double residual = 0.0;    ///< s, median distance of the changes from the fit
  std::size_t changes = 0;  ///< changes that both have and that fit
  double share = 0.0;       ///< of the session's changes in the time of the recording

  double toSession(double recorded) const { return recorded * (1.0 + drift) + offset; }
};

/// Fits the clocks of two groups of rows. Fails with NotFound if too few changes agree: then the
/// recordings are of different robots or matches.
Result<ClockFit> fitClocks(const telemetry::SessionReader& session, telemetry::GroupId robot,
                           const telemetry::SessionReader& recording, telemetry::GroupId recorded);

struct JoinOptions {
  std::string robot;  ///< name in the session; empty: the robot with the number of the recording
  std::optional<double> offset, drift;  ///< given by hand, instead of fitted
  bool replace = false;                 ///< an existing output
};

struct JoinReport {
  std::string robot;
  ClockFit clock;
  std::uint64_t rows = 0;      ///< of the recording
  std::uint64_t replaced = 0;  ///< rows of the session that they replace
  /// Returns a line for people, with offset, drift and residual.
  std::string summary() const;
};

/// Writes the joined session. Fails with NotFound if the session has no values of the robot, as
/// fitClocks() does, with Conflict if `progress` (0 to 1) returns false, and as FileTarget does.
Result<JoinReport> joinRecording(const std::string& session, const std::string& recording,
                                 const std::string& output, const JoinOptions& options,
                                 const std::function<bool(double)>& progress = {});

}  // namespace pitchboard::link
