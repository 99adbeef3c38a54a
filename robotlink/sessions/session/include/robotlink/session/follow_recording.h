// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Collects from the frames of any source (simulated, live or recorded) what robots and ball of a
// match follow that begins at a moment of it (followed_recording.h). Metres, radians, seconds of
// the source. Plain values; any thread that may read the source.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <base/result.h>
#include <robotlink/frame/match_frame.h>
#include <robotlink/match/followed_recording.h>
#include <robotlink/scenario/scenario.h>

namespace pitchboard::link {

struct FollowOptions {
  std::vector<std::string> who;  ///< "ball", a team's colour, or a robot's name such as "R1"
  double reach = FollowedRecording::defaultReach;
  double from = 0.0, until = 0.0;  ///< s of the source
  double matchTime = 0.0;          ///< s of the match at `from`
};

/// Returns what they do. `frameAt` returns the frame at a time of the source, or null; it is asked
/// for every tick of `scenario`, whose robots those of the frames are by team and number. Fails
/// with NotFound for a name that none of them has, and if nothing is recorded of who follows.
Result<FollowedRecording> recordingToFollow(
    const std::function<std::shared_ptr<const MatchFrame>(double time)>& frameAt,
    const Scenario& scenario, const FollowOptions& options);

}  // namespace pitchboard::link
