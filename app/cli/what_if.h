// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// "What if" in the command line: a match starts at a moment of a recording, some robots follow the
// recording while others play, and many runs give rates to compare with what was recorded. Main
// thread. Metres, seconds.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <robotlink/match/followed_recording.h>
#include <robotlink/match/moment.h>
#include <robotlink/match/tick_observer.h>
#include <robotlink/scenario/scenario.h>
#include <telemetry/session/session_reader.h>

namespace pitchboard::cli {

/// A moment of a recording from which a match starts.
struct RecordedStart {
  telemetry::SessionReader session;
  double time = 0.0;                   ///< s of the session
  link::Scenario scenario;             ///< of the recorded match; without a moment, from here on
  std::optional<link::Moment> moment;  ///< the exact state, if the recording has it
  std::vector<std::string> notes;      ///< what could not be carried over

  /// Returns the time at which the match starts, in its own seconds.
  double matchTime() const;
};

/// Reads the moment. Recordings of real robots have no exact state: then the match starts where the
/// robots believed they were.
Result<RecordedStart> recordedStart(telemetry::SessionReader session, const std::string& path,
                                    double time);

struct WhatIfOptions {
  std::vector<std::string> follow;  ///< FollowOptions::who
  double reach = link::FollowedRecording::defaultReach;
  int runs = 0;  ///< 0: one match, with its own summary
  bool json = false;
};

using Following = std::shared_ptr<const link::FollowedRecording>;

/// Returns what the match of `scenario` follows until it ends; null if nobody follows.
Result<Following> followedBy(const WhatIfOptions& options, const RecordedStart& start,
                             const link::Scenario& scenario);

/// Creates and plays a match to its end.
using PlayRun = std::function<Result<void>(const link::Scenario& scenario,
                                           const std::shared_ptr<link::TickObserver>& observer)>;

/// Plays options.runs matches, each until a goal or the end of the scenario, with the seeds from
/// that of the scenario on, and prints how often each outcome came. Fails with Conflict if the user
/// interrupts it.
Result<void> playWhatIf(const WhatIfOptions& options, const RecordedStart& start,
                        const link::Scenario& scenario, const Following& recording,
                        const PlayRun& play);

}  // namespace pitchboard::cli
