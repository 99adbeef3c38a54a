// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Turns the frame of any source (simulated, live or recorded) into the belief that rollouts start
// from: who plays, where robots and ball are and how certain that is, and the game. What the frame
// does not know is left out or assumed, and listed in the notes. Metres, radians, seconds, the
// studio's frame. Plain values and a pure function; any thread.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <base/result.h>
#include <base/robot_key.h>
#include <robotlink/frame/match_frame.h>
#include <robotlink/rollout/belief.h>
#include <robotlink/scenario/scenario.h>

namespace pitchboard::link {

struct ExploreStartOptions {
  /// Uses the true poses and the true ball where the frame has them. Otherwise robots stand where
  /// they believe they are, and the ball lies where they see it.
  bool useTruth = false;
  /// Robot models, noise and physics come from this scenario; without it all robots are kid-size
  /// with realistic noise. Must outlive the call.
  const Scenario* base = nullptr;
  /// Returns the frame of an earlier time (s of the source), or null. It is asked for a ball that
  /// nobody sees now, and for the ball's speed. May be empty.
  std::function<std::shared_ptr<const MatchFrame>(double time)> earlier;
};

struct ExploreStart {
  rollout::Setup setup;
  rollout::Belief belief;
  /// The players, in the order of the setup.
  std::vector<RobotUid> robots;
  std::vector<std::string> names;
  /// Sentences about what was left out or assumed.
  std::vector<std::string> notes;
};

/// Returns the start of rollouts from this frame. Fails with NotFound if no robot's pose or no ball
/// is known, and with Unsupported after the end of a game.
Result<ExploreStart> exploreStart(const MatchFrame& frame, const ExploreStartOptions& options = {});

}  // namespace pitchboard::link
